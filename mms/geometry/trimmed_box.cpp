#include "mms/geometry/trimmed_box.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {

Eigen::AlignedBox3f trimmed_box(const std::vector<Eigen::Vector3f>& points, double trim) {
  Eigen::AlignedBox3f box;
  if (points.empty()) return box;
  const auto cut = static_cast<std::ptrdiff_t>(trim * static_cast<double>(points.size()));
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][axis];
    const auto low = values.begin() + cut;
    const auto high = values.end() - 1 - cut;
    std::nth_element(values.begin(), low, values.end());
    box.min()[axis] = *low;
    std::nth_element(low, high, values.end());
    box.max()[axis] = *high;
  }
  return box;
}

}  // namespace mms
