#pragma once

#include <array>
#include <cstdint>
#include <vector>

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

/// IoU thresholds of a hit: 0.50, 0.55, ..., 0.95.
constexpr std::array kIouThresholds = linspace<10>(0.5, 0.95);

/// Result of the matching for one detection.
enum class Verdict : std::uint8_t {
  kHit,
  kFalseAlarm,
  kIgnored,  ///< on an object that does not count: neither hit nor miss
};

/// Verdicts on one detection, one per threshold of kIouThresholds.
using Verdicts = std::array<Verdict, kIouThresholds.size()>;

/// Properties of a ground-truth object for the matching.
struct MatchObject {
  bool crowd = false;    ///< matches any number of detections
  bool ignored = false;  ///< a crowd, or outside the size range
};

/// IoU in one image: rows are detections, highest score first; columns are objects.
using Overlaps = std::vector<std::vector<double>>;

/// Greedy matching as in COCOeval.evaluateImg: each detection takes the free object with the
/// highest IoU at or above the threshold (the last of equals); an ignored object only if no other
/// is left. @return one entry per detection, in the order of the rows
std::vector<Verdicts> match_masks(const Overlaps& overlaps,
                                  const std::vector<MatchObject>& objects);

}  // namespace mms
