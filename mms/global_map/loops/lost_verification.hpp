#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "mms/global_map/loops/keyframe_alignment.hpp"
#include "mms/global_map/loops/loop_verification.hpp"

namespace mms {

/// [-]: pairs of keypoints of a lost frame, as a multiple of those of a loop. Source: no odometry
/// confirms the place; in a hall that is turned by half a turn, views agree in up to 1.5.
inline constexpr double kLostFactor = 1.5;

/// Checks whether a frame whose pose is lost shows the place of a keyframe: half of its view may be
/// covered, and no odometry confirms the place.
class LostFrameVerifier {
 public:
  LostFrameVerifier(const LoopConfig& config, const RegistrationConfig& registration,
                    const DepthNoise& noise);

  /// A candidate of place recognition. Pairs of keypoints come from all keyframes around it.
  /// @param records  of all keyframes
  /// @param poses    of these, in one frame; only neighboring ones must be consistent
  /// @returns with the keyframe of them that is nearest to the pose
  Loop verify(const std::deque<KeyframeRecord>& records,
              const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
              const KeyframeRecord& query) const;

  /// The same with a relative pose that the odometry has found, in doubt.
  Loop verify_nearby(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                     const KeyframeRecord& query, const Eigen::Isometry3d& T_candidate_query) const;

 private:
  void check(const std::deque<KeyframeRecord>& records, const std::vector<Eigen::Isometry3d>& poses,
             const KeyframeRecord& query, double min_overlap, double min_pairs, Loop& loop) const;
  int pairs_at(const std::deque<KeyframeRecord>& records,
               const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
               const Loop& loop) const;
  double contradiction_around(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses, std::size_t keyframe,
                              const KeyframeView& view, const Eigen::Isometry3d& pose) const;

  LoopConfig config_;
  KeyframeAligner aligner_;
  LoopVerifier loops_;
  DepthNoise noise_;
};

}  // namespace mms
