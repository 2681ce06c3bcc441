#include "mms/mapping/tracking/motion_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mms {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// [m^2/s]: spectral density of the height's drift. Source: 0.1 m after one second, as for a person
/// who bends or a box of which more comes into view.
constexpr double kHeightNoise = 0.01;

/// [-]: standard deviations up to which a measurement has its full weight. Source: normal noise in
/// three dimensions exceeds them once in 60,000 measurements.
constexpr double kHuberThreshold = 5.0;

/// [s]: time constant of an offset's changes. Source: a person's gait cycle, in which the visible
/// part of a truncated body changes.
constexpr double kOffsetTime = 1.0;

/// [m^2], [m^2/s^2]: variance added to what has none. Source: the square of 0.03 mm, far below any
/// sensor's noise, keeps a matrix invertible.
constexpr double kMinVariance = 1e-9;

}  // namespace

MotionFilter::MotionFilter(const Vector3d& position, const Vector3d& up, double position_sigma,
                           double velocity_sigma)
    : horizontal_(Matrix3d::Identity() - up * up.transpose()) {
  state_.head<3>() = position;
  covariance_.topLeftCorner<3, 3>().diagonal().setConstant(position_sigma * position_sigma);
  covariance_.block<3, 3>(3, 3) = velocity_sigma * velocity_sigma * horizontal_;
}

MotionFilter::Covariance MotionFilter::transition(double seconds) const {
  Covariance transition = Covariance::Identity();
  transition.block<3, 3>(0, 3) = seconds * Matrix3d::Identity();
  transition.bottomRightCorner<3, 3>() *= std::exp(-seconds / kOffsetTime);
  return transition;
}

void MotionFilter::predict(double seconds, double noise) {
  const Covariance step = transition(seconds);
  const double kept = step(8, 8);
  const Matrix3d acceleration = noise * seconds * horizontal_;
  const Matrix3d drift = kHeightNoise * seconds * (Matrix3d::Identity() - horizontal_);
  Covariance added = Covariance::Zero();
  added.topLeftCorner<6, 6>() << acceleration * (seconds * seconds / 3.0) + drift,
      acceleration * (seconds / 2.0), acceleration * (seconds / 2.0), acceleration;
  const double renewed = (1.0 - kept * kept) * offset_sigma_ * offset_sigma_;
  added.bottomRightCorner<3, 3>().diagonal().setConstant(renewed);
  state_ = step * state_;
  covariance_ = step * covariance_ * step.transpose() + added;
  corrections_.setZero();
}

void MotionFilter::smooth(const MotionFilter& later, double seconds, double noise) {
  MotionFilter expected = *this;
  expected.predict(seconds, noise);
  // The later estimate has no information on an offset that began or ended in between.
  const bool same_offset = offset_sigma_ > 0.0 && later.offset_sigma_ > 0.0;
  const Eigen::Index size = same_offset ? 9 : 6;
  Eigen::MatrixXd innovation = expected.covariance_.topLeftCorner(size, size);
  innovation.diagonal().array() += kMinVariance;
  const Eigen::MatrixXd joint = (transition(seconds) * covariance_).topRows(size);
  const Eigen::MatrixXd gain = innovation.ldlt().solve(joint).transpose();
  state_ += gain * (later.state_ - later.corrections_ - expected.state_).head(size);
  const Covariance change = later.covariance_ - expected.covariance_;
  covariance_ += gain * change.topLeftCorner(size, size) * gain.transpose();
}

void MotionFilter::shift(const Vector3d& by) {
  state_.head<3>() += by;
  corrections_.head<3>() += by;
}

void MotionFilter::set_up(const Vector3d& up) {
  horizontal_ = Matrix3d::Identity() - up * up.transpose();
  Covariance level = Covariance::Identity();
  level.block<3, 3>(3, 3) = horizontal_;
  state_ = level * state_;
  covariance_ = level * covariance_ * level;
}

void MotionFilter::begin_offset(double sigma) {
  if (offset_sigma_ == 0.0) {
    covariance_.bottomRightCorner<3, 3>().diagonal().setConstant(sigma * sigma);
  }
  offset_sigma_ = sigma;
}

void MotionFilter::end_offset() {
  offset_sigma_ = 0.0;
  state_.tail<3>().setZero();
  covariance_.rightCols<3>().setZero();
  covariance_.bottomRows<3>().setZero();
}

void MotionFilter::update(const Vector3d& position, const PositionError& error) {
  if (error.offset > 0.0) begin_offset(error.offset);
  Eigen::Matrix<double, 3, 9> measured = Eigen::Matrix<double, 3, 9>::Zero();
  measured.leftCols<3>().setIdentity();
  if (error.offset > 0.0) measured.rightCols<3>().setIdentity();
  const Vector3d off = position - measured * state_;
  const Matrix3d expected = measured * covariance_ * measured.transpose();
  const Matrix3d noise = error.noise * error.noise * Matrix3d::Identity();
  const double sigmas = std::sqrt(off.dot((expected + noise).inverse() * off));
  const Matrix3d innovation = expected + std::max(1.0, sigmas / kHuberThreshold) * noise;
  const Eigen::Matrix<double, 9, 3> gain =
      covariance_ * measured.transpose() * innovation.inverse();
  state_ += gain * off;
  covariance_ -= (gain * measured * covariance_).eval();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  if (error.offset == 0.0) end_offset();
}

void MotionFilter::limit_speed(double speed) {
  const double now = velocity().norm();
  if (now <= speed) return;
  const Vector3d excess = (1.0 - speed / now) * velocity();
  state_.segment<3>(3) -= excess;
  corrections_.segment<3>(3) -= excess;
}

}  // namespace mms
