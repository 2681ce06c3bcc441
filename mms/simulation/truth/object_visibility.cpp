#include "mms/simulation/truth/object_visibility.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

constexpr float kMinDepth = 0.05F;    // points nearer to the image plane have no pixel [m]
constexpr double kMaxSamples = 1500;  // rays for measuring an object's occlusion

/// Bounds of the actor's parts in the object's own frame.
Eigen::AlignedBox3d body_box(const Stage& stage, std::size_t actor) {
  const Eigen::Isometry3f T_object_building =
      stage.T_building_object(actor).inverse().cast<float>();
  Eigen::AlignedBox3f box;
  for (std::size_t i = stage.first_part(actor); i < stage.last_part(actor); ++i) {
    box.extend(bounds(stage.part(i), T_object_building * stage.T_building_part(i)));
  }
  return box.cast<double>();
}

/// Pixel of a point, without distortion outside the range of the lens model.
Eigen::Vector2d pixel_of(const CameraModel& camera, const Eigen::Vector3d& point) {
  if (camera.in_lens_range(point)) return camera.project(point);
  const CameraIntrinsics& k = camera.intrinsics();
  return {k.fx * point.x() / point.z() + k.cx, k.fy * point.y() / point.z() + k.cy};
}

/// Bounds of the actor's projection, without the part behind the camera.
Eigen::AlignedBox2d projected_box(const Stage& stage, std::size_t actor, const CameraModel& camera,
                                  const Eigen::Isometry3f& T_camera_building) {
  Eigen::AlignedBox2d box;
  for (std::size_t i = stage.first_part(actor); i < stage.last_part(actor); ++i) {
    const Eigen::Isometry3f T = T_camera_building * stage.T_building_part(i);
    for (const Vertex& vertex : stage.part(i).vertices) {
      const Eigen::Vector3f point = T * vertex.position;
      if (point.z() > kMinDepth) box.extend(pixel_of(camera, point.cast<double>()));
    }
  }
  return box;
}

/// As a rectangle of whole pixels.
PixelBox rectangle(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return {};
  const Eigen::Vector2d size = box.sizes() + Eigen::Vector2d(1.0, 1.0);
  return {box.min().x() - 0.5, box.min().y() - 0.5, size.x(), size.y()};
}

Eigen::AlignedBox2d image_box(const CameraIntrinsics& camera) {
  return {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(camera.width - 1, camera.height - 1)};
}

void measure_pixels(const ExactView& view, const Eigen::AlignedBox2d& where, ObjectTruth& object) {
  if (where.isEmpty()) return;
  Eigen::AlignedBox2d box;
  for (int y = static_cast<int>(where.min().y()); y <= static_cast<int>(where.max().y()); ++y) {
    for (int x = static_cast<int>(where.min().x()); x <= static_cast<int>(where.max().x()); ++x) {
      if (view.object(x, y) != object.id + 1) continue;
      ++object.pixels;
      box.extend(Eigen::Vector2d(x, y));
    }
  }
  object.visible = rectangle(box);
}

/// Share of the object's pixels in `where` that show another object.
double occlusion(const Stage& stage, const ExactView& view, const CameraModel& camera,
                 const Eigen::Isometry3d& T_building_camera, const Eigen::AlignedBox2d& where,
                 int id) {
  if (where.isEmpty()) return 0.0;
  const int step = std::max(1, static_cast<int>(std::sqrt(where.volume() / kMaxSamples)));
  std::vector<Ray> rays;
  std::vector<std::uint8_t> seen;
  const Eigen::Isometry3f T = T_building_camera.cast<float>();
  for (int y = static_cast<int>(where.min().y()); y <= static_cast<int>(where.max().y());
       y += step) {
    for (int x = static_cast<int>(where.min().x()); x <= static_cast<int>(where.max().x());
         x += step) {
      const Eigen::Vector3f direction = camera.ray(Eigen::Vector2d(x, y)).cast<float>();
      rays.push_back({T.translation(), T.linear() * direction});
      seen.push_back(view.object(x, y) == id + 1 ? 1 : 0);
    }
  }
  std::vector<RayHit> hits(rays.size());
  const auto actor = static_cast<std::size_t>(id);
  stage.rays().cast_at_parts(rays, stage.first_part(actor), stage.last_part(actor), hits);
  double whole = 0.0;
  double hidden = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].valid()) continue;
    whole += 1.0;
    hidden += seen[i] == 0 ? 1.0 : 0.0;
  }
  return whole > 0.0 ? hidden / whole : 0.0;
}

ObjectTruth describe(const Stage& stage, std::size_t actor) {
  ObjectTruth object;
  object.id = static_cast<int>(actor);
  object.object_class = stage.actors()[actor].model->object_class();
  object.kind = stage.actors()[actor].model->kind();
  const Eigen::AlignedBox3d box = body_box(stage, actor);
  object.half_extent = 0.5 * box.sizes();
  object.T_world_box = stage.T_building_object(actor) * Eigen::Translation3d(box.center());
  return object;
}

}  // namespace

std::vector<ObjectTruth> visible_objects(const Stage& stage, const ExactView& view,
                                         const CameraIntrinsics& camera,
                                         const Eigen::Isometry3d& T_building_camera) {
  const CameraModel model(camera);
  const Eigen::Isometry3f T_camera_building = T_building_camera.inverse().cast<float>();
  std::vector<ObjectTruth> objects;
  for (std::size_t actor = 0; actor < stage.actors().size(); ++actor) {
    ObjectTruth object = describe(stage, actor);
    const Eigen::AlignedBox2d whole = projected_box(stage, actor, model, T_camera_building);
    object.amodal = rectangle(whole);
    const Eigen::AlignedBox2d inside =
        whole.isEmpty() ? whole : whole.intersection(image_box(camera));
    measure_pixels(view, inside, object);
    object.occlusion = occlusion(stage, view, model, T_building_camera, inside, object.id);
    const double area = object.amodal.width * object.amodal.height;
    const PixelBox part = rectangle(inside);
    object.truncation = area > 0.0 ? 1.0 - part.width * part.height / area : 0.0;
    objects.push_back(std::move(object));
  }
  return objects;
}

Image<std::uint8_t> label_image(const Stage& stage, const ExactView& view) {
  Image<std::uint8_t> mask = view.object;
  for (std::uint8_t& value : mask.pixels()) {
    if (value == 0) continue;
    const ObjectClass object_class = stage.actors()[value - 1U].model->object_class();
    value = static_cast<std::uint8_t>(1 + static_cast<int>(object_class));
  }
  return mask;
}

}  // namespace mms
