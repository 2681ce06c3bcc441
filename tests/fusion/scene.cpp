#include "tests/fusion/scene.hpp"

#include <algorithm>
#include <limits>

#include "mms/geometry/camera.hpp"

namespace mms::testing {
namespace {

/// Mask of the pixels with a pixel of value `wanted` within a square of that radius [pixels].
Image<std::uint8_t> spread(const Image<std::uint8_t>& mask, int radius, std::uint8_t wanted) {
  Image<std::uint8_t> result(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if ((mask(x, y) != 0) != (wanted != 0)) continue;
      for (int v = std::max(0, y - radius); v <= std::min(mask.height() - 1, y + radius); ++v) {
        for (int u = std::max(0, x - radius); u <= std::min(mask.width() - 1, x + radius); ++u) {
          result(u, v) = 1;
        }
      }
    }
  }
  return result;
}

}  // namespace

Scene& Scene::add(Surface surface, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  blocks.push_back({surface, Eigen::AlignedBox3f(low, high)});
  return *this;
}

Scene::Hit Scene::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  Hit nearest;
  for (const Block& block : blocks) {
    const Eigen::Array3f a = (block.box.min() - origin).array() / direction.array();
    const Eigen::Array3f b = (block.box.max() - origin).array() / direction.array();
    const float enter = a.min(b).maxCoeff();
    const float leave = a.max(b).minCoeff();
    if (enter > leave || enter <= 0.0F) continue;
    if (nearest.surface == Surface::kNone || enter < nearest.distance) {
      nearest = {enter, block.surface};
    }
  }
  return nearest;
}

Scene room() {
  return Scene()
      .add(Surface::kFloor, {-6.0F, 1.2F, -6.0F}, {6.0F, 1.3F, 6.0F})
      .add(Surface::kWall, {-6.0F, -3.0F, 4.0F}, {6.0F, 1.2F, 4.1F});
}

Scene room_with_person(float x) {
  return room().add(Surface::kPerson, {x, -0.5F, 2.5F}, {x + 0.5F, 1.2F, 2.8F});
}

CameraIntrinsics test_camera() {
  CameraIntrinsics camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

View render(const Scene& scene) {
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = test_camera();
  const int width = calibration->camera->width;
  const int height = calibration->camera->height;
  View view{{}, Image<Surface>(width, height, Surface::kNone)};
  view.frame.name = "synthetic";
  view.frame.calibration = calibration;
  view.frame.depth = Image<float>(width, height);
  view.frame.color = Image<Rgb>(width, height, Rgb{100, 110, 120});
  const auto rays = CameraModel(*calibration->camera).ray_table();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Scene::Hit hit = scene.cast(Eigen::Vector3f::Zero(), rays[i]);
    view.frame.depth[i] = hit.distance;
    view.truth[i] = hit.surface;
  }
  return view;
}

Instance mask_of(const View& view, Surface surface, int grow) {
  Instance instance;
  Image<std::uint8_t> mask(view.truth.width(), view.truth.height());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = view.truth[i] == surface ? 1 : 0;
  if (grow > 0) mask = spread(mask, grow, 1);
  if (grow < 0) {
    mask = spread(mask, -grow, 0);
    for (auto& pixel : mask.pixels()) pixel = pixel == 0 ? 1 : 0;
  }
  instance.mask = std::move(mask);
  return instance;
}

Segmentation segmentation_of(const View& view, std::vector<Instance> instances) {
  return {view.truth.width(), view.truth.height(), std::move(instances)};
}

}  // namespace mms::testing
