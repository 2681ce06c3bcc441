#include "mms/localization/features/feature_exclusion.hpp"

#include <cmath>

#include "mms/geometry/camera.hpp"
#include "mms/localization/features/intensity_pyramid.hpp"

namespace mms {
namespace {

template <class IsExcluded>
void erase_features(FeatureCloud& features, const IsExcluded& is_excluded) {
  std::erase_if(features.edges, is_excluded);
  std::erase_if(features.planes, is_excluded);
}

}  // namespace

void exclude(const Image<std::uint8_t>& points, const LabeledCloud& cloud, FeatureCloud& features) {
  if (!cloud.organised()) {
    erase_features(features, [&](const auto& feature) {
      return feature.index >= 0 && points[static_cast<std::size_t>(feature.index)] != 0;
    });
    return;
  }
  const CameraModel model(cloud.camera);
  erase_features(features, [&](const auto& feature) {
    const Eigen::Vector3d point = feature.point.template cast<double>();
    if (!(point.z() > 0.0) || !model.in_lens_range(point)) return false;
    const Eigen::Vector2d pixel = model.project(point);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    return points.contains(x, y) && points(x, y) != 0;
  });
  keep_clear(points, features.intensity);
}

}  // namespace mms
