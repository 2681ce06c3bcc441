#include "mms/localization/features/feature_cloud.hpp"

#include <algorithm>
#include <utility>

#include "mms/core/upper_median.hpp"

namespace mms {
namespace {

/// [-]: voxels in the median range. Source: rooms and streets then give about as many points;
/// 8 cm at 2 m, 40 cm at 10 m.
constexpr double kVoxelsPerRange = 25.0;

/// [m]: smallest automatic voxel. Source: 2.5 sigma of a LiDAR's 2 cm, below which a surface
/// fills several layers of voxels.
constexpr double kMinVoxel = 0.05;

/// [m]: largest automatic voxel. Source: that of KISS-ICP (Vizzo et al., RA-L 2023) for vehicles
/// with 100 m of range.
constexpr double kMaxVoxel = 1.0;

}  // namespace

double median_range(std::vector<float> ranges) {
  return ranges.empty() ? 0.0 : static_cast<double>(upper_median(std::move(ranges)));
}

double median_range(const FeatureCloud& features) {
  std::vector<float> ranges;
  ranges.reserve(features.planes.size() + features.edges.size());
  for (const PlaneFeature& f : features.planes) ranges.push_back(f.point.norm());
  for (const EdgeFeature& f : features.edges) ranges.push_back(f.point.norm());
  return median_range(std::move(ranges));
}

double automatic_voxel_size(double median_range) {
  return std::clamp(median_range / kVoxelsPerRange, kMinVoxel, kMaxVoxel);
}

}  // namespace mms
