#include "mms/report/plot_axis.hpp"

#include <algorithm>
#include <cmath>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

bool plottable(double value) {
  constexpr double kMaxValue = 1e9;
  return std::abs(value) <= kMaxValue;
}

std::optional<AxisRange> range_of(std::span<const std::vector<double>> series, double margin) {
  std::optional<AxisRange> range;
  for (const std::vector<double>& values : series) {
    for (const double value : values) {
      if (!plottable(value)) continue;
      if (!range) range = AxisRange{value, value};
      range->min = std::min(range->min, value);
      range->max = std::max(range->max, value);
    }
  }
  if (!range) return range;
  // Range around a constant: 5 % of the value, at least of 1, to either side.
  constexpr double kAroundConstant = 0.05;
  const double magnitude = std::max(std::abs(range->min), std::abs(range->max));
  const bool constant = range->length() <= 1e-9 * magnitude;
  const double added =
      constant ? kAroundConstant * std::max(magnitude, 1.0) : margin * range->length();
  return AxisRange{range->min - added, range->max + added};
}

std::vector<double> ticks(const AxisRange& range, double spacing) {
  const double power = std::pow(10.0, std::floor(std::log10(spacing)));
  const double digit = spacing / power;
  const double step = power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
  std::vector<double> values;
  for (double i = std::ceil(range.min / step - 1e-9); i * step <= range.max + 1e-9 * step; ++i) {
    values.push_back(i * step);
  }
  return values;
}

std::string tick_label(double value, std::span<const double> ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : std::abs(value);
  const double places = step > 0.0 ? std::ceil(-std::log10(step) - 1e-9) : 0.0;
  return to_fixed(value == 0.0 ? 0.0 : value, static_cast<int>(std::clamp(places, 0.0, 9.0)));
}

}  // namespace mms
