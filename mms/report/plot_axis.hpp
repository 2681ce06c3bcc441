#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mms {

/// Numbers a plot can show; the others (NaN, infinities, numbers no axis could label) are gaps.
bool plottable(double value);

/// Interval of values along one axis, min < max.
struct AxisRange {
  double min = 0.0;
  double max = 1.0;

  double length() const { return max - min; }
};

/// Smallest interval with all plottable values of `series`, widened at both ends by `margin` of its
/// length; a single value gets room around it. Nothing where there is no value.
std::optional<AxisRange> range_of(std::span<const std::vector<double>> series, double margin);

/// Multiples inside `range` of the step nearest to `spacing` > 0 that is 1, 2 or 5 times a power of
/// ten.
std::vector<double> ticks(const AxisRange& range, double spacing);

/// `value` with as many places as neighbouring ticks of `ticks` need to differ.
std::string tick_label(double value, std::span<const double> ticks);

}  // namespace mms
