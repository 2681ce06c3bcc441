#pragma once

#include <array>
#include <cstddef>

namespace mms {

/// `kCount` numbers from `first` to `last`, bitwise equal to numpy.linspace: evaluated at compile
/// time, without fused multiply-add.
template <std::size_t kCount>
consteval std::array<double, kCount> linspace(double first, double last) {
  std::array<double, kCount> values{};
  const double step = (last - first) / static_cast<double>(kCount - 1);
  for (std::size_t i = 0; i < kCount; ++i) values[i] = static_cast<double>(i) * step + first;
  values.back() = last;
  return values;
}

}  // namespace mms
