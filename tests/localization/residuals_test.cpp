#include "mms/localization/registration/residuals.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mms {
namespace {

constexpr double kStep = 1e-6;

class Random {
 public:
  Eigen::Vector3d vector(double scale) {
    const double x = unit_(random_);
    const double y = unit_(random_);
    return scale * Eigen::Vector3d(x, y, unit_(random_));
  }
  Eigen::Vector3d direction() { return vector(1.0).normalized(); }
  Eigen::Isometry3d pose() {
    Vector6d x;
    x.head<3>() = vector(3.0);
    x.tail<3>() = vector(1.5);
    return se3::exp(x);
  }

 private:
  std::mt19937 random_{17};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

/// T with its k-th coordinate perturbed on the right.
Eigen::Isometry3d perturbed(const Eigen::Isometry3d& T, int k, double step) {
  return T * se3::exp(step * Vector6d::Unit(k));
}

/// Eq. (3) as printed: |(p - a) x (p - b)| / |a - b|.
TEST(PointToLine, NormEqualsEquation3) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d T = random.pose();
    const Eigen::Vector3d point = random.vector(4.0);
    const Eigen::Vector3d a = random.vector(4.0);
    const Eigen::Vector3d b = random.vector(4.0);
    const Eigen::Vector3d p = T * point;
    const double expected = (p - a).cross(p - b).norm() / (a - b).norm();
    const auto r = point_to_line(T, point, a, (a - b).normalized());
    EXPECT_NEAR(r.value.norm(), expected, 1e-9);
  }
}

/// Eq. (4) as printed: (p - a) . ((a - b) x (a - c)) / |(a - b) x (a - c)|.
TEST(PointToPlane, EqualsEquation4) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d T = random.pose();
    const Eigen::Vector3d point = random.vector(4.0);
    const Eigen::Vector3d a = random.vector(4.0);
    const Eigen::Vector3d cross = (a - random.vector(4.0)).cross(a - random.vector(4.0));
    const double expected = (T * point - a).dot(cross) / cross.norm();
    EXPECT_NEAR(point_to_plane(T, point, a, cross.normalized()).value, expected, 1e-9);
  }
}

TEST(PointToPlane, JacobianEqualsNumericDerivative) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d T = random.pose();
    const Eigen::Vector3d point = random.vector(4.0);
    const Eigen::Vector3d on_plane = random.vector(4.0);
    const Eigen::Vector3d normal = random.direction();
    const auto value = [&](const Eigen::Isometry3d& pose) {
      return point_to_plane(pose, point, on_plane, normal).value;
    };
    const Vector6d analytic = point_to_plane(T, point, on_plane, normal).jacobian;
    for (int k = 0; k < 6; ++k) {
      const double numeric =
          (value(perturbed(T, k, kStep)) - value(perturbed(T, k, -kStep))) / (2.0 * kStep);
      EXPECT_NEAR(analytic(k), numeric, 1e-8);
    }
  }
}

TEST(PointToLine, JacobianEqualsNumericDerivative) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d T = random.pose();
    const Eigen::Vector3d point = random.vector(4.0);
    const Eigen::Vector3d on_line = i % 5 == 0 ? Eigen::Vector3d(T * point) : random.vector(4.0);
    const Eigen::Vector3d direction = random.direction();
    const auto value = [&](const Eigen::Isometry3d& pose) {
      return point_to_line(pose, point, on_line, direction).value;
    };
    const auto analytic = point_to_line(T, point, on_line, direction).jacobian;
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d numeric =
          (value(perturbed(T, k, kStep)) - value(perturbed(T, k, -kStep))) / (2.0 * kStep);
      EXPECT_LT((analytic.col(k) - numeric).norm(), 1e-8);
    }
  }
}

TEST(Residuals, VanishOnLineAndPlane) {
  const Eigen::Isometry3d T = Random().pose();
  const Eigen::Vector3d point(1.0, 2.0, 3.0);
  const Eigen::Vector3d direction = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const Eigen::Vector3d beside = T * point + 7.0 * direction;
  EXPECT_NEAR(point_to_line(T, point, beside, direction).value.norm(), 0.0, 1e-12);
  EXPECT_NEAR(point_to_plane(T, point, beside, direction.unitOrthogonal()).value, 0.0, 1e-12);
  EXPECT_NEAR(point_to_plane(T, point, beside, direction).value, -7.0, 1e-12);
}

}  // namespace
}  // namespace mms
