#pragma once

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>

#include "mms/core/time.hpp"

namespace mms {

/// [s]: time between two measurements from which on they are not connected.
/// Source: at 1 m/s and 0.5 m/s^2, a motion interpolated over it is wrong by 4 mm.
inline constexpr double kMaxSampleInterval = 0.25;

/// [s]: time after the last measurement up to which it is extended.
/// Source: the interval of two frames of a camera of 15 Hz.
inline constexpr double kMaxExtension = 0.07;

/// [s]: measurements older than this are forgotten.
/// Source: longer than a sensor is in the dark, and less than 1 MB at 200 Hz.
inline constexpr double kMaxSampleAge = 60.0;

/// Two neighboring measurements; a time lies between them, or shortly after.
template <class Sample>
struct SamplePair {
  const Sample* before;
  const Sample* after;
  double share;  ///< 0 at `before`, 1 at `after`, beyond 1 after the last measurement
};

/// The first measurement after a time.
template <class Sample>
auto first_after(const std::deque<Sample>& samples, Timestamp stamp) {
  return std::upper_bound(samples.begin(), samples.end(), stamp,
                          [](Timestamp at, const Sample& sample) { return at < sample.stamp; });
}

/// The measurements around a time; nothing before the first and long after the last one, or in a
/// gap.
template <class Sample>
std::optional<SamplePair<Sample>> samples_around(const std::deque<Sample>& samples,
                                                 Timestamp stamp) {
  auto after = first_after(samples, stamp);
  if (after == samples.begin() || samples.size() < 2) return std::nullopt;
  if (after == samples.end()) --after;
  if (after == samples.begin()) return std::nullopt;
  const Sample& before = *std::prev(after);
  const double interval = to_seconds(after->stamp - before.stamp);
  if (interval > kMaxSampleInterval) return std::nullopt;
  if (to_seconds(stamp - after->stamp) > kMaxExtension) return std::nullopt;
  return SamplePair<Sample>{&before, &*after, to_seconds(stamp - before.stamp) / interval};
}

/// Whether measurements between two times are missing.
template <class Sample>
bool has_gap(const std::deque<Sample>& samples, Timestamp from, Timestamp to) {
  for (auto at = first_after(samples, from); at != samples.end() && at->stamp < to; ++at) {
    const auto next = std::next(at);
    if (next == samples.end()) return false;
    if (to_seconds(next->stamp - at->stamp) > kMaxSampleInterval) return true;
  }
  return false;
}

template <class Sample>
void forget_old(std::deque<Sample>& samples) {
  while (!samples.empty() &&
         to_seconds(samples.back().stamp - samples.front().stamp) > kMaxSampleAge) {
    samples.pop_front();
  }
}

}  // namespace mms
