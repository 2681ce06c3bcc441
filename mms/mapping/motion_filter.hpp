#pragma once

#include <Eigen/Core>

namespace mms {

/// Position and velocity of a point that goes over the floor and keeps its velocity but for random
/// accelerations (a Kalman filter with white acceleration noise; Bar-Shalom et al., Estimation with
/// Applications to Tracking and Navigation, 2001, 6.2). Its height drifts, and has no velocity: a
/// body that comes into view does not rise. World frame, [m] and [m/s].
class MotionFilter {
 public:
  using Covariance = Eigen::Matrix<double, 6, 6>;

  /// At rest at `position`, with standard deviations [m] and [m/s].
  /// @param up  of length 1
  MotionFilter(const Eigen::Vector3d& position, const Eigen::Vector3d& up, double position_sigma,
               double velocity_sigma);

  /// @param seconds  not negative
  /// @param noise    spectral density of the acceleration [m^2/s^3]
  void predict(double seconds, double noise);

  /// Takes another direction for the upright one.
  void set_up(const Eigen::Vector3d& up);

  /// Takes in a measured position with its standard deviation [m]. One that is farther off than is
  /// likely counts as little as that is unlikely (Huber's weights).
  void update(const Eigen::Vector3d& position, double sigma);

  /// Moves the point without a motion: it was taken for another.
  void shift(const Eigen::Vector3d& by) { state_.head<3>() += by; }

  /// Shortens the velocity to a length [m/s].
  void limit_speed(double speed);

  Eigen::Vector3d position() const { return state_.head<3>(); }
  Eigen::Vector3d velocity() const { return state_.tail<3>(); }
  Eigen::Matrix3d position_covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  Eigen::Matrix3d velocity_covariance() const { return covariance_.bottomRightCorner<3, 3>(); }

 private:
  Eigen::Matrix3d horizontal_;  ///< projection
  Eigen::Matrix<double, 6, 1> state_;
  Covariance covariance_;
};

}  // namespace mms
