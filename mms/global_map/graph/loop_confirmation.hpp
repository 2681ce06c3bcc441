#pragma once

#include <cstddef>
#include <vector>

#include "mms/global_map/graph/loop_graph.hpp"

namespace mms {

/// Accepts a loop only where the odometry allows it and a loop of a keyframe before agrees.
class LoopConfirmation {
 public:
  /// Whether the odometry since the candidate allows the relative pose. Where nothing relates the
  /// two, more keypoints must agree.
  /// @param min_inliers  pairs of keypoints of a loop
  bool is_likely(const LoopGraph& graph, const Loop& loop, int min_inliers) const;

  /// Accepts the last loop if one of the keyframes before has a loop that agrees, and that one too.
  /// Where nothing relates the sessions, all that agree need many keypoints together.
  /// @param min_inliers  pairs of keypoints of a loop
  /// @returns the loops that are accepted now, as edges of the graph
  std::vector<Loop> confirm(LoopGraph& graph, int min_inliers);

 private:
  std::vector<std::size_t> pending_;  ///< indices of recent loops that wait for confirmation
};

}  // namespace mms
