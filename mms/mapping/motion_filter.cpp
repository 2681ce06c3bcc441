#include "mms/mapping/motion_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mms {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kHeightNoise = 0.01;  // spectral density of the height's drift [m^2/s]
constexpr double kLikely = 5.0;        // standard deviations

}  // namespace

MotionFilter::MotionFilter(const Vector3d& position, const Vector3d& up, double position_sigma,
                           double velocity_sigma)
    : horizontal_(Matrix3d::Identity() - up * up.transpose()) {
  state_ << position, Vector3d::Zero();
  covariance_.setZero();
  covariance_.topLeftCorner<3, 3>().diagonal().setConstant(position_sigma * position_sigma);
  covariance_.bottomRightCorner<3, 3>() = velocity_sigma * velocity_sigma * horizontal_;
}

void MotionFilter::predict(double seconds, double noise) {
  Covariance transition = Covariance::Identity();
  transition.topRightCorner<3, 3>() = seconds * Matrix3d::Identity();
  const Matrix3d acceleration = noise * seconds * horizontal_;
  const Matrix3d drift = kHeightNoise * seconds * (Matrix3d::Identity() - horizontal_);
  Covariance added;
  added << acceleration * (seconds * seconds / 3.0) + drift, acceleration * (seconds / 2.0),
      acceleration * (seconds / 2.0), acceleration;
  state_ = transition * state_;
  covariance_ = transition * covariance_ * transition.transpose() + added;
}

void MotionFilter::set_up(const Vector3d& up) {
  horizontal_ = Matrix3d::Identity() - up * up.transpose();
  Covariance level = Covariance::Identity();
  level.bottomRightCorner<3, 3>() = horizontal_;
  state_ = level * state_;
  covariance_ = level * covariance_ * level;
}

void MotionFilter::update(const Vector3d& position, double sigma) {
  const Vector3d off = position - state_.head<3>();
  const Matrix3d expected = covariance_.topLeftCorner<3, 3>();
  const Matrix3d noise = sigma * sigma * Matrix3d::Identity();
  const double sigmas = std::sqrt(off.dot((expected + noise).inverse() * off));
  const Matrix3d innovation = expected + std::max(1.0, sigmas / kLikely) * noise;
  const Eigen::Matrix<double, 6, 3> gain = covariance_.leftCols<3>() * innovation.inverse();
  state_ += gain * off;
  covariance_ -= (gain * covariance_.topRows<3>()).eval();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

void MotionFilter::limit_speed(double speed) {
  const double now = velocity().norm();
  if (now > speed) state_.tail<3>() *= speed / now;
}

}  // namespace mms
