#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "mms/geometry/se3.hpp"

namespace mms {

/// Result of the checks of a loop, in their order; the first that fails decides.
enum class LoopOutcome : std::uint8_t {
  kAccepted,
  kFewMatches,     ///< too few pairs of similar keypoints
  kFewInliers,     ///< too few pairs agree with a relative pose
  kNotSpread,      ///< these are in too small a part of the image, or of the floor
  kNotRegistered,  ///< the static features do not fit
  kLittleOverlap,  ///< the views share too few surfaces
  kContradiction,  ///< points of one view are in free space of the other
  kOtherTexture,   ///< the weak texture of shared surfaces differs
  kUnlikely,       ///< the odometry excludes the relative pose
  kUnconfirmed,    ///< no neighboring keyframe has a loop that agrees
  kInconsistent,   ///< the other edges of the pose graph exclude it
};

/// [-]: the number of them. Source: `LoopOutcome`.
inline constexpr int kLoopOutcomes = 11;

constexpr std::string_view to_string(LoopOutcome outcome) {
  constexpr std::array<std::string_view, kLoopOutcomes> kNames = {
      "accepted",       "few matches",    "few inliers",   "not spread",
      "not registered", "little overlap", "contradiction", "other texture",
      "unlikely",       "unconfirmed",    "inconsistent"};
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
  double dissimilarity = 0.0;  ///< of the weak texture of shared surfaces

  /// Standard deviation of the position in its least certain direction [m], as if the rotation was
  /// known; 0 before it is estimated.
  double sigma() const;
};

}  // namespace mms
