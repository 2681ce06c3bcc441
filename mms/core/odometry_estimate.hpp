#pragma once

#include <Eigen/Core>
#include <string_view>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Quality of a frame's pose.
enum class Status {
  kInitialized,  ///< first frame: the pose is the origin by definition
  kTracking,     ///< estimated from enough well distributed static points
  kDegenerate,   ///< estimated, but directions with too little information are predicted
  kLost,         ///< too few inliers: the pose is the motion prediction
  kRecovered,    ///< first estimated frame after lost ones
};
inline constexpr int kStatusCount = 5;

constexpr std::string_view to_string(Status status) {
  constexpr std::string_view kNames[kStatusCount] = {"initialized", "tracking", "degenerate",
                                                     "lost", "recovered"};
  return kNames[static_cast<int>(status)];
}

/// Pose of one frame (III-C.3) with quality measures.
struct OdometryEstimate {
  /// Translation first, then rotation.
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  Timestamp stamp;                          ///< of the frame
  Transform<World, Sensor> T_world_sensor;  ///< estimated pose
  Status status = Status::kInitialized;     ///< of the pose
  /// Gauss-Newton information matrix of a right perturbation (translation [1/m^2], rotation
  /// [1/rad^2]) in the sensor frame.
  Matrix6d information = Matrix6d::Zero();
  int intensity_inliers = 0;      ///< residuals of the photometric term
  int degenerate_directions = 0;  ///< number of degenerate directions, of 6
};

}  // namespace mms
