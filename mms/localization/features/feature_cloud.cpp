#include "mms/localization/features/feature_cloud.hpp"

#include <algorithm>

namespace mms {

double median_range(const FeatureCloud& features) {
  std::vector<float> ranges;
  ranges.reserve(features.planes.size() + features.edges.size());
  for (const PlaneFeature& f : features.planes) ranges.push_back(f.point.norm());
  for (const EdgeFeature& f : features.edges) ranges.push_back(f.point.norm());
  if (ranges.empty()) return 0.0;
  const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
  std::nth_element(ranges.begin(), middle, ranges.end());
  return static_cast<double>(*middle);
}

}  // namespace mms
