#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mms/core/object_box.hpp"

namespace mms {

/// Pairs the true and tracked boxes of one frame after the other.
class ObjectPairing {
 public:
  explicit ObjectPairing(double max_distance) : max_distance_(max_distance) {}

  /// Index of the tracked box of every true one, -1 for none: pairs of ids of earlier frames first,
  /// the others so that the distances add up to the least.
  std::vector<int> pair(const std::vector<ObjectBox>& truth, const std::vector<ObjectBox>& tracks);

 private:
  double max_distance_;
  std::map<int, int> track_of_;  ///< by id of the true object
};

/// Over how many frames each pair of ids (true, tracked) lay within a distance of each other.
using PairCounts = std::map<std::pair<int, int>, std::int64_t>;

/// Most frames that a one-to-one pairing of ids can explain.
std::int64_t best_identity_matches(const PairCounts& counts);

}  // namespace mms
