#include "mms/io/cloud/point_fields.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

double unit_of(bool integer, double span) {
  constexpr double kMinScanTime = 2e-3;  // duration of a scan [s]
  constexpr double kMaxScanTime = 10.0;
  if (!integer && span < kMaxScanTime) return 1.0;
  return span * 1e-9 < kMinScanTime ? 1e-6 : 1e-9;
}

}  // namespace

std::vector<float> relative_point_times(const std::vector<double>& times, bool integer,
                                        std::optional<Timestamp> stamp) {
  double first = INFINITY;
  double last = -INFINITY;
  for (const double time : times) {
    if (!std::isfinite(time)) continue;
    first = std::min(first, time);
    last = std::max(last, time);
  }
  if (!(first <= last)) return {};
  const double unit = unit_of(integer, last - first);
  constexpr double kAbsolute = 1e6;  // [s]: larger times are absolute, as no scan takes eleven days
  const bool absolute = first * unit > kAbsolute;
  const double start = stamp ? stamp->seconds() : first * unit;
  std::vector<float> result(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double since = times[i] * unit - (absolute ? start : 0.0);
    result[i] = std::isfinite(since) ? static_cast<float>(since) : 0.0F;
  }
  return result;
}

}  // namespace mms
