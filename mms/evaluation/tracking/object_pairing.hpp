#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mms/core/object_box.hpp"

namespace mms {

/// Pairs ground-truth and tracked boxes, frame by frame.
class ObjectPairing {
 public:
  explicit ObjectPairing(double max_distance) : max_distance_(max_distance) {}

  /// Index of the tracked box of every ground-truth box, -1 for none: pairs of earlier frames are
  /// kept, the others minimize the sum of distances.
  std::vector<int> pair(const std::vector<ObjectBox>& truth, const std::vector<ObjectBox>& tracks);

 private:
  double max_distance_;
  std::map<int, int> track_of_;  ///< by id of the ground-truth object
};

/// Number of frames in which each pair of ids (ground truth, track) was within the matching
/// distance.
using PairCounts = std::map<std::pair<int, int>, std::int64_t>;

/// Largest number of frames that a one-to-one pairing of ids explains.
std::int64_t best_identity_matches(const PairCounts& counts);

}  // namespace mms
