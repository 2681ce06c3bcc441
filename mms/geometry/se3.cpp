#include "mms/geometry/se3.hpp"

#include <cmath>

namespace mms::se3 {
namespace {

/// Below this angle [rad] the closed forms suffer from cancellation; the series is used.
constexpr double kSmallAngle = 1e-3;

/// sin(a)/a, (1-cos(a))/a^2 and (a-sin(a))/a^3.
struct Coefficients {
  double sinc;
  double half;
  double sixth;
};

Coefficients coefficients(double angle) {
  const double a2 = angle * angle;
  if (angle < kSmallAngle) {
    return {1.0 - a2 / 6.0 + a2 * a2 / 120.0, 0.5 - a2 / 24.0 + a2 * a2 / 720.0,
            1.0 / 6.0 - a2 / 120.0 + a2 * a2 / 5040.0};
  }
  return {std::sin(angle) / angle, (1.0 - std::cos(angle)) / a2,
          (angle - std::sin(angle)) / (a2 * angle)};
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& rotation) {
  const Coefficients c = coefficients(rotation.norm());
  const Eigen::Matrix3d w = hat(rotation);
  return Eigen::Matrix3d::Identity() + c.half * w + c.sixth * w * w;
}

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  const double scale =
      sine < 0.5 * kSmallAngle ? 2.0 + sine * sine / 3.0 : 2.0 * std::atan2(sine, q.w()) / sine;
  return scale * q.vec();
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Isometry3d exp(const Vector6d& tangent) {
  const Eigen::Vector3d rotation = tangent.tail<3>();
  const Coefficients c = coefficients(rotation.norm());
  const Eigen::Matrix3d w = hat(rotation);
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = Eigen::Matrix3d::Identity() + c.sinc * w + c.half * w * w;
  transform.translation() = left_jacobian(rotation) * tangent.head<3>();
  return transform;
}

Vector6d log(const Eigen::Isometry3d& transform) {
  Vector6d tangent;
  tangent.tail<3>() = rotation_log(transform.linear());
  tangent.head<3>() = left_jacobian(tangent.tail<3>()).lu().solve(transform.translation());
  return tangent;
}

Matrix6d adjoint(const Eigen::Isometry3d& transform) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = transform.linear();
  ad.topRightCorner<3, 3>() = hat(transform.translation()) * transform.linear();
  ad.bottomRightCorner<3, 3>() = transform.linear();
  return ad;
}

Eigen::Isometry3d interpolate(const Eigen::Isometry3d& transform, double t) {
  return exp(t * log(transform));
}

Eigen::Isometry3d normalized(const Eigen::Isometry3d& transform) {
  Eigen::Isometry3d result = transform;
  result.linear() = Eigen::Quaterniond(transform.linear()).normalized().toRotationMatrix();
  return result;
}

double angle(const Eigen::Isometry3d& transform) {
  return rotation_log(transform.linear()).norm();
}

}  // namespace mms::se3
