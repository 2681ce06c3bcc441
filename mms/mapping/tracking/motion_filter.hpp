#pragma once

#include <Eigen/Core>

namespace mms {

/// Error of a measured position [m].
struct PositionError {
  double noise = 0.0;   ///< standard deviation, independent between measurements
  double offset = 0.0;  ///< standard deviation of an error that persists for a while; 0: none
};

/// Position and velocity of a point that moves over the floor with constant velocity and random
/// accelerations (a Kalman filter with white acceleration noise; Bar-Shalom et al., Estimation with
/// Applications to Tracking and Navigation, 2001, 6.2). Its height drifts without a velocity: a
/// body that comes into view does not rise. Measurements of a part of an object have an offset that
/// persists while only that part is visible, and that is estimated too (8.3): when all of it comes
/// into view, the position changes, the velocity does not. World frame, [m] and [m/s].
class MotionFilter {
 public:
  /// At rest at `position`, with standard deviations [m] and [m/s].
  /// @param up  of length 1
  MotionFilter(const Eigen::Vector3d& position, const Eigen::Vector3d& up, double position_sigma,
               double velocity_sigma);

  /// @param seconds  not negative
  /// @param noise    spectral density of the acceleration [m^2/s^3]
  void predict(double seconds, double noise);

  /// Replaces the upright direction.
  void set_up(const Eigen::Vector3d& up);

  /// Updates with a measured position. The weight of an unlikely one falls with its distance
  /// (Huber's weights).
  void update(const Eigen::Vector3d& position, const PositionError& error);

  /// Improves the estimate by a later one (a step of the smoother of Rauch, Tung and
  /// Striebel; 8.6).
  /// @param later    this filter after that time and an update, and after its own `smooth` if any
  /// @param seconds  until then, positive
  /// @param noise    that of `predict`
  void smooth(const MotionFilter& later, double seconds, double noise);

  /// Corrects the position without a motion: another point of the object is tracked from now on.
  void shift(const Eigen::Vector3d& by);

  /// Shortens the velocity to a length [m/s].
  void limit_speed(double speed);

  Eigen::Vector3d position() const { return state_.head<3>(); }
  Eigen::Vector3d velocity() const { return state_.segment<3>(3); }
  Eigen::Matrix3d position_covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  Eigen::Matrix3d velocity_covariance() const { return covariance_.block<3, 3>(3, 3); }

 private:
  /// Position, velocity, offset.
  using State = Eigen::Matrix<double, 9, 1>;
  using Covariance = Eigen::Matrix<double, 9, 9>;

  Covariance transition(double seconds) const;
  void begin_offset(double sigma);
  void end_offset();

  Eigen::Matrix3d horizontal_;  ///< projection
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  State corrections_ = State::Zero();  ///< by `shift` and `limit_speed` since the last prediction
  double offset_sigma_ = 0.0;          ///< 0 while the measurements have no offset
};

}  // namespace mms
