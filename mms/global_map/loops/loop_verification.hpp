#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/keyframe_alignment.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/global_map/loops/loop_config.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

/// [-]: keyframes before and after one whose features are the local map of its place. Source: about
/// 1 m on each side, so that the local map exceeds the view.
inline constexpr std::size_t kNeighbors = 3;

/// [-]: keyframes before and after one whose views are compared with another view. Source: in
/// places that look alike, a part of them shows a difference; 1.5 m on each side.
inline constexpr std::size_t kViewsAround = 6;

/// First and end of the keyframes around one in its session.
/// @param count  of them before and after it
std::pair<std::size_t, std::size_t> neighbors(const std::deque<KeyframeRecord>& records,
                                              std::size_t keyframe, std::size_t count = kNeighbors);

/// Pairs of keypoints that a loop of a keyframe needs.
int min_inliers_of(const LoopConfig& config, const KeyframeRecord& keyframe);

/// Checks whether two keyframes show the same place, by their static points alone.
class LoopVerifier {
 public:
  LoopVerifier(const LoopConfig& config, const RegistrationConfig& registration,
               const DepthNoise& noise);

  /// A candidate of place recognition: the relative pose comes from pairs of keypoints.
  /// @param records  of all earlier keyframes
  /// @param poses    of these, in one frame; only neighboring ones must be consistent
  /// @param query    becomes the next keyframe
  Loop verify(const std::deque<KeyframeRecord>& records,
              const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
              const KeyframeRecord& query) const;

  /// A candidate nearby: the relative pose is known but for some centimeters.
  Loop verify_nearby(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                     const KeyframeRecord& query, const Eigen::Isometry3d& T_candidate_query) const;

  /// The checks beyond the keypoints: registration, overlap, free space and texture.
  /// @param loop  has candidate and first pose; receives the others and the first check that failed
  /// @returns whether all hold
  bool is_same_place(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                     double min_overlap, Loop& loop) const;

 private:
  bool register_features(const std::deque<KeyframeRecord>& records,
                         const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                         Loop& loop) const;
  double dissimilarity_around(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses, std::size_t keyframe,
                              const KeyframeView& view, const Eigen::Isometry3d& pose) const;
  bool compare(const KeyframeRecord& a, const KeyframeRecord& b, double min_overlap,
               Loop& loop) const;

  LoopConfig config_;
  KeyframeAligner aligner_;
  RegistrationConfig registration_;
  DepthNoise noise_;
};

}  // namespace mms
