#include "mms/localization/features/feature_exclusion.hpp"

#include <cmath>
#include <vector>

#include "mms/geometry/camera.hpp"
#include "mms/localization/features/intensity_pyramid.hpp"

namespace mms {

void exclude(const Image<std::uint8_t>& pixels, const CameraIntrinsics& camera,
             FeatureCloud& features) {
  const CameraModel model(camera);
  const auto is_excluded = [&](const auto& feature) {
    const Eigen::Vector3d point = feature.point.template cast<double>();
    if (!(point.z() > 0.0) || !model.in_lens_range(point)) return false;
    const Eigen::Vector2d pixel = model.project(point);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    return pixels.contains(x, y) && pixels(x, y) != 0;
  };
  std::erase_if(features.edges, is_excluded);
  std::erase_if(features.planes, is_excluded);
  keep_clear(pixels, features.intensity);
}

void exclude_dynamic(const std::vector<PointLabel>& labels, FeatureCloud& features) {
  const auto is_excluded = [&](const auto& feature) {
    return feature.index >= 0 &&
           labels[static_cast<std::size_t>(feature.index)] != PointLabel::kStatic;
  };
  std::erase_if(features.edges, is_excluded);
  std::erase_if(features.planes, is_excluded);
}

}  // namespace mms
