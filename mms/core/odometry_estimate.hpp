#pragma once

#include <Eigen/Core>
#include <string_view>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// How far a frame's pose can be trusted.
enum class Status {
  kInitialized,  ///< first frame: the pose is the origin by definition
  kTracking,     ///< estimated from enough well spread static points
  kDegenerate,   ///< estimated, but some directions had too little information and were predicted
  kLost,         ///< too few inliers: the pose is the motion prediction
  kRecovered,    ///< first estimated frame after lost ones
};
inline constexpr int kStatusCount = 5;

constexpr std::string_view to_string(Status status) {
  constexpr std::string_view kNames[kStatusCount] = {"initialized", "tracking", "degenerate",
                                                     "lost", "recovered"};
  return kNames[static_cast<int>(status)];
}

/// Pose of one frame (III-C.3) with what is needed to judge it.
struct OdometryEstimate {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  Timestamp stamp;
  Transform<World, Sensor> T_world_sensor;
  Status status = Status::kInitialized;
  /// Gauss-Newton information of a right perturbation (translation [1/m^2], rotation [1/rad^2])
  /// in the sensor frame.
  Matrix6d information = Matrix6d::Zero();
  int edge_inliers = 0;
  int plane_inliers = 0;
  int intensity_inliers = 0;
  int iterations = 0;
  int degenerate_directions = 0;  ///< of 6
  double plane_rms = 0.0;         ///< of the inlying point-to-plane residuals [m]
};

}  // namespace mms
