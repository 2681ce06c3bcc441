#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mms {

/// The value in the center of the sorted `values`, the larger one of two. There is at least one.
template <class T>
T upper_median(std::vector<T> values) {
  const auto center = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), center, values.end());
  return *center;
}

}  // namespace mms
