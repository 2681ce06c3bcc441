#include "mms/geometry/depth_registration.hpp"

#include <algorithm>
#include <cmath>

namespace mms {

/// Color pixels that a depth pixel covers, and its depth in the color camera.
struct DepthRegistration::Footprint {
  int left = 0;
  int right = 0;  // included
  int top = 0;
  int bottom = 0;  // included
  float depth = 0.0F;
};

DepthRegistration::DepthRegistration(const DepthCamera& depth, const CameraIntrinsics& color)
    : depth_camera_(depth.camera), color_(color), T_color_depth_(depth.T_color_depth.isometry()) {
  const CameraModel model(depth_camera_);
  centers_ = model.ray_table();
  corners_.reserve(static_cast<std::size_t>(depth_camera_.width + 1) *
                   static_cast<std::size_t>(depth_camera_.height + 1));
  for (int y = 0; y <= depth_camera_.height; ++y) {
    for (int x = 0; x <= depth_camera_.width; ++x) {
      corners_.push_back(model.ray(Eigen::Vector2d(x - 0.5, y - 0.5)).cast<float>());
    }
  }
}

std::optional<DepthRegistration::Footprint> DepthRegistration::footprint(int x, int y,
                                                                         float depth) const {
  // Neighbors on a slanted surface have footprints with small gaps between them.
  constexpr double kMargin = 0.25;  // [px]
  const auto row = static_cast<std::size_t>(depth_camera_.width + 1);
  const std::size_t corner = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
  const std::size_t center = corner - static_cast<std::size_t>(y);
  const auto in_color = [&](const Eigen::Vector3f& ray) {
    return Eigen::Vector3d(T_color_depth_ * (ray * depth).cast<double>());
  };
  const Eigen::Vector3d first = in_color(corners_[corner]);
  const Eigen::Vector3d second = in_color(corners_[corner + row + 1]);
  const double z = in_color(centers_[center]).z();
  if (!(first.z() > 0.0 && second.z() > 0.0 && z > 0.0)) return std::nullopt;
  if (!color_.in_lens_range(first) || !color_.in_lens_range(second)) return std::nullopt;
  const Eigen::Vector2d a = color_.project(first);
  const Eigen::Vector2d b = color_.project(second);
  const Eigen::Vector2d low = a.cwiseMin(b).array() - kMargin;
  const Eigen::Vector2d high = a.cwiseMax(b).array() + kMargin;
  const CameraIntrinsics& color = color_.intrinsics();
  if (!(low.x() < color.width && low.y() < color.height && high.x() >= 0.0 && high.y() >= 0.0)) {
    return std::nullopt;
  }
  const auto first_in = [](double from) {
    return static_cast<int>(std::max(0.0, std::ceil(from)));
  };
  const auto last_in = [](double to, int size) {
    return static_cast<int>(std::min(std::floor(to), static_cast<double>(size - 1)));
  };
  return Footprint{first_in(low.x()), last_in(high.x(), color.width), first_in(low.y()),
                   last_in(high.y(), color.height), static_cast<float>(z)};
}

Image<float> DepthRegistration::apply(const Image<float>& depth) const {
  Image<float> result(color_.intrinsics().width, color_.intrinsics().height);
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const float z = depth(x, y);
      if (!(std::isfinite(z) && z > 0.0F)) continue;
      const auto pixels = footprint(x, y, z);
      if (!pixels) continue;
      for (int v = pixels->top; v <= pixels->bottom; ++v) {
        for (int u = pixels->left; u <= pixels->right; ++u) {
          float& nearest = result(u, v);
          if (nearest == 0.0F || pixels->depth < nearest) nearest = pixels->depth;
        }
      }
    }
  }
  return result;
}

std::optional<DepthRegistration> make_registration(const Calibration& calibration) {
  if (!calibration.depth_camera || !calibration.camera) return std::nullopt;
  return DepthRegistration(*calibration.depth_camera, *calibration.camera);
}

std::shared_ptr<const Calibration> registered_calibration(
    const std::shared_ptr<const Calibration>& calibration) {
  if (!calibration->depth_camera) return calibration;
  Calibration registered = *calibration;
  registered.depth_camera.reset();
  return std::make_shared<const Calibration>(std::move(registered));
}

}  // namespace mms
