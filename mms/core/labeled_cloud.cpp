#include "mms/core/labeled_cloud.hpp"

#include <algorithm>

namespace mms {

double dynamic_share(const LabeledCloud& cloud) {
  const auto dynamic = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic);
  const auto fixed = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kStatic);
  const auto valid = dynamic + fixed;
  return valid == 0 ? 0.0 : static_cast<double>(dynamic) / static_cast<double>(valid);
}

}  // namespace mms
