#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/global_map/loops/loop.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

struct LoopConfig {
  int min_inliers = 20;
  int min_scan_inliers = 10;
  double min_overlap = 0.2;
  double max_contradiction = 0.02;
  double max_dissimilarity = 0.15;

  void visit(ConfigVisitor& v) {
    v.integer({"min_inliers", "", "pairs of keypoints that must agree with the relative pose"},
              min_inliers, {6, 10000});
    v.integer({"min_scan_inliers", "", "the same of LiDAR scans, whose keypoints are on the floor"},
              min_scan_inliers, {4, 10000});
    v.number({"min_overlap", "",
              "share of the static points of each view that must lie on surfaces of the other"},
             min_overlap, {0.0, 1.0});
    v.number({"max_contradiction", "",
              "largest share of points in view that lie in free space of the other view"},
             max_contradiction, {0.0, 1.0});
    v.number({"max_dissimilarity", "",
              "largest share of weakly textured patches of both views that do not correlate"},
             max_dissimilarity, {0.0, 1.0});
  }
};

/// [-]: keyframes before and after one whose features are the local map of its place. Source: about
/// 1 m on each side, so that the local map exceeds the view.
inline constexpr std::size_t kNeighbors = 3;

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
  /// @param query    becomes the next keyframe, or is a frame whose pose is lost
  Loop verify(const std::deque<KeyframeRecord>& records,
              const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
              const KeyframeRecord& query) const;

  /// A candidate for a frame whose pose is lost: half of its view may be covered, and no odometry
  /// confirms the place. Pairs of keypoints come from all keyframes around the candidate.
  /// @returns with the one of them that is nearest to the pose
  Loop verify_lost(const std::deque<KeyframeRecord>& records,
                   const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                   const KeyframeRecord& query) const;

  /// The same with a relative pose that the odometry has found, in doubt.
  Loop verify_lost_nearby(const std::deque<KeyframeRecord>& records,
                          const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                          const KeyframeRecord& query,
                          const Eigen::Isometry3d& T_candidate_query) const;

  /// A candidate nearby: the relative pose is known but for some centimeters.
  Loop verify_nearby(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                     const KeyframeRecord& query, const Eigen::Isometry3d& T_candidate_query) const;

 private:
  bool align(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const;
  bool align_scans(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const;
  bool align_keypoints(const ImageKeypoints& a, const ImageKeypoints& b, Loop& loop) const;
  void check_lost(const std::deque<KeyframeRecord>& records,
                  const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                  double min_overlap, double min_pairs, Loop& loop) const;
  int pairs_at(const std::deque<KeyframeRecord>& records,
               const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
               const Loop& loop) const;
  double contradiction_around(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses, std::size_t keyframe,
                              const KeyframeView& view, const Eigen::Isometry3d& pose) const;
  bool register_features(const std::deque<KeyframeRecord>& records,
                         const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                         Loop& loop) const;
  bool is_same_place(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                     double min_overlap, Loop& loop) const;
  double dissimilarity_around(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses, std::size_t keyframe,
                              const KeyframeView& view, const Eigen::Isometry3d& pose) const;
  bool compare(const KeyframeRecord& a, const KeyframeRecord& b, double min_overlap,
               Loop& loop) const;

  LoopConfig config_;
  RegistrationConfig registration_;
  DepthNoise noise_;
};

}  // namespace mms
