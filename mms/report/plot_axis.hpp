#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mms {

/// Whether a value can be plotted; others (NaN, infinities, very large numbers) are gaps.
bool plottable(double value);

/// Interval of values along one axis, min < max.
struct AxisRange {
  double min = 0.0;
  double max = 1.0;

  double length() const { return max - min; }

  /// This interval, or one of length `extent` around its center if that is longer.
  AxisRange widened_to(double extent) const {
    const double added = 0.5 * (extent - length());
    return added > 0.0 ? AxisRange{min - added, max + added} : *this;
  }
};

/// Smallest interval with all plottable values of `series`, extended at both ends by `margin` of
/// its length; for a single value an interval around it. nullopt without values.
std::optional<AxisRange> range_of(std::span<const std::vector<double>> series, double margin);

/// Multiples inside `range` of a step of 1, 2 or 5 times a power of ten nearest to `spacing` > 0.
std::vector<double> ticks(const AxisRange& range, double spacing);

/// `value` with as many decimals as needed to distinguish adjacent ticks.
std::string tick_label(double value, std::span<const double> ticks);

}  // namespace mms
