#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mms/evaluation/segmentation/linspace.hpp"

namespace mms {

/// The overlaps (IoU) a detection has to have to be a hit: 0.50, 0.55, ..., 0.95.
constexpr std::array kIouThresholds = linspace<10>(0.5, 0.95);

/// What a detection is found to be.
enum class Verdict : std::uint8_t {
  kHit,
  kFalseAlarm,
  kIgnored,  ///< on an object that does not count: neither for nor against
};

/// The verdicts on one detection, one for each of kIouThresholds.
using Verdicts = std::array<Verdict, kIouThresholds.size()>;

/// What the matching has to know of an object of the truth.
struct MatchObject {
  bool crowd = false;    ///< any number of detections may lie on it
  bool ignored = false;  ///< a crowd, or of a size that is not asked for
};

/// Overlaps of one image: a row a detection, the highest score first; a column an object.
using Overlaps = std::vector<std::vector<double>>;

/// COCO's greedy matching, as in COCOeval.evaluateImg: each detection takes, of the objects still
/// free, the one of the highest overlap at or above the threshold (of equals the last); an ignored
/// object only where no other is left.
/// @return one entry a detection, in the order of the rows
std::vector<Verdicts> match_masks(const Overlaps& overlaps,
                                  const std::vector<MatchObject>& objects);

}  // namespace mms
