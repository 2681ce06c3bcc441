#include "mms/core/labeled_cloud.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace mms {

namespace {

double share_of_valid(std::ptrdiff_t points, const LabeledCloud& cloud) {
  const auto invalid = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kInvalid);
  const auto valid = static_cast<std::ptrdiff_t>(cloud.labels.size()) - invalid;
  return valid == 0 ? 0.0 : static_cast<double>(points) / static_cast<double>(valid);
}

}  // namespace

double dynamic_share(const LabeledCloud& cloud) {
  return share_of_valid(std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic),
                        cloud);
}

double overruled_share(const LabeledCloud& cloud, const Image<std::uint8_t>& overruled) {
  const auto& points = overruled.pixels();
  const auto kept = std::count(points.begin(), points.end(), std::uint8_t{0});
  return share_of_valid(static_cast<std::ptrdiff_t>(points.size()) - kept, cloud);
}

}  // namespace mms
