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

/// The time that the others are relative to, in their unit.
struct PointOrigin {
  double time = 0.0;
  bool other_clock = false;
};

/// @param earliest  time
/// @param unit      of the times [s]
PointOrigin origin_of(double earliest, double unit, std::optional<Timestamp> stamp) {
  // [s]: larger times are absolute, as no scan takes eleven days
  constexpr double kAbsolute = 1e6;
  // [s]: farthest times of points from their stamp, as of scans in files. Those of a sensor whose
  // clock is not set count from its start, and may be minutes.
  constexpr double kReach = 1.0;
  const double seconds = earliest * unit;
  if (!stamp) return {seconds > kAbsolute ? earliest : 0.0, false};
  if (std::abs(seconds) <= kReach) return {};
  if (std::abs(seconds - stamp->seconds()) <= kReach) return {stamp->seconds() / unit, false};
  return {earliest, true};
}

}  // namespace

PointTimes relative_point_times(const std::vector<double>& times, bool integer,
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
  const PointOrigin origin = origin_of(first, unit, stamp);
  PointTimes result{std::vector<float>(times.size()), origin.other_clock};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double since = (times[i] - origin.time) * unit;
    result.offsets[i] = std::isfinite(since) ? static_cast<float>(since) : 0.0F;
  }
  return result;
}

}  // namespace mms
