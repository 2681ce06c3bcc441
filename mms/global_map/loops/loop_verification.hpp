#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>
#include <utility>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

struct LoopConfig {
  int min_inliers = 20;
  double min_overlap = 0.2;
  double max_contradiction = 0.02;

  void visit(ConfigVisitor& v) {
    v.integer({"min_inliers", "", "pairs of keypoints that must agree with the relative pose"},
              min_inliers, {6, 10000});
    v.number({"min_overlap", "",
              "share of the static points of each view that must lie on surfaces of the other"},
             min_overlap, {0.0, 1.0});
    v.number({"max_contradiction", "",
              "largest share of points in view that lie in free space of the other view"},
             max_contradiction, {0.0, 1.0});
  }
};

/// Result of the checks of a loop, in their order; the first that fails decides.
enum class LoopOutcome : std::uint8_t {
  kAccepted,
  kFewMatches,     ///< too few pairs of similar keypoints
  kFewInliers,     ///< too few pairs agree with a relative pose
  kNotSpread,      ///< these are in too small a part of the image
  kNotRegistered,  ///< the static features do not fit
  kLittleOverlap,  ///< the views share too few surfaces
  kContradiction,  ///< points of one view are in free space of the other
  kUnlikely,       ///< the odometry excludes the relative pose
  kUnconfirmed,    ///< no neighboring keyframe has a loop that agrees
  kInconsistent,   ///< the other edges of the pose graph exclude it
};

/// [-]: the number of them. Source: `LoopOutcome`.
inline constexpr int kLoopOutcomes = 10;

constexpr std::string_view to_string(LoopOutcome outcome) {
  constexpr std::array<std::string_view, kLoopOutcomes> kNames = {
      "accepted",       "few matches",   "few inliers", "not spread",  "not registered",
      "little overlap", "contradiction", "unlikely",    "unconfirmed", "inconsistent"};
  return kNames[static_cast<std::size_t>(outcome)];
}

/// A possible loop between two keyframes.
struct Loop {
  std::size_t candidate = 0;  ///< number of the earlier keyframe
  std::size_t query = 0;      ///< number of the later keyframe
  LoopOutcome outcome = LoopOutcome::kFewMatches;
  Eigen::Isometry3d T_candidate_query = Eigen::Isometry3d::Identity();  ///< as far as estimated
  Matrix6d information = Matrix6d::Zero();                              ///< as that of `PoseEdge`
  int inliers = 0;             ///< pairs of keypoints; 0 for a candidate nearby
  double overlap = 0.0;        ///< the smaller one of both views
  double contradiction = 0.0;  ///< the larger one of both views

  /// Standard deviation of the position in its least certain direction [m], as if the rotation was
  /// known; 0 before it is estimated.
  double sigma() const;
};

/// First and end of the keyframes around one in its session, whose features are the local map of
/// its place.
std::pair<std::size_t, std::size_t> neighbors(const std::deque<KeyframeRecord>& records,
                                              std::size_t keyframe);

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

  /// A candidate nearby: the relative pose is known but for some centimeters.
  Loop verify_nearby(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                     const KeyframeRecord& query, const Eigen::Isometry3d& T_candidate_query) const;

 private:
  bool align_keypoints(const ImageKeypoints& a, const ImageKeypoints& b, Loop& loop) const;
  bool register_features(const std::deque<KeyframeRecord>& records,
                         const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                         Loop& loop) const;
  bool is_same_place(const std::deque<KeyframeRecord>& records,
                     const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                     Loop& loop) const;
  bool compare(const KeyframeView& a, const KeyframeView& b, Loop& loop) const;

  LoopConfig config_;
  RegistrationConfig registration_;
  DepthNoise noise_;
};

}  // namespace mms
