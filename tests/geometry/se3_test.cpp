#include "mms/geometry/se3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

namespace mms {
namespace {

/// Tangents with rotations of every size: tiny, ordinary, and close to half a turn.
std::vector<Vector6d> tangents(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const std::vector<double> angles = {0.0,  1e-12, 1e-8, 1e-5, 4e-4,        9.99e-4,    1.001e-3,
                                      1e-2, 0.3,   1.0,  2.5,  M_PI - 1e-2, M_PI - 1e-4};
  std::vector<Vector6d> all;
  for (int i = 0; i < count; ++i) {
    Vector6d x;
    for (int k = 0; k < 6; ++k) x(k) = unit(random);
    x.head<3>() *= 5.0;
    x.tail<3>() = angles[static_cast<std::size_t>(i) % angles.size()] * x.tail<3>().normalized();
    all.push_back(x);
  }
  return all;
}

double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

Eigen::Matrix4d generator(const Vector6d& x) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = se3::hat(x.tail<3>());
  m.topRightCorner<3, 1>() = x.head<3>();
  return m;
}

TEST(Se3, HatIsCrossProduct) {
  const Eigen::Vector3d a(1.0, -2.0, 3.0);
  const Eigen::Vector3d b(0.3, 0.7, -0.2);
  EXPECT_TRUE((se3::hat(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST(Se3, ExpEqualsMatrixExponential) {
  for (const Vector6d& x : tangents(200)) {
    const Eigen::Matrix4d expected = generator(x).exp();
    EXPECT_LT((se3::exp(x).matrix() - expected).cwiseAbs().maxCoeff(), 1e-12) << x.transpose();
  }
}

TEST(Se3, LogInvertsExp) {
  for (const Vector6d& x : tangents(500)) {
    // The logarithm loses digits as the rotation comes near half a turn.
    const double tolerance = x.tail<3>().norm() > 3.0 ? 1e-9 : 1e-12;
    EXPECT_LT((se3::log(se3::exp(x)) - x).norm(), tolerance) << x.transpose();
  }
}

TEST(Se3, ExpInvertsLogAtHalfTurn) {
  for (const Vector6d& x : tangents(50)) {
    Vector6d half = x;
    half.tail<3>() = M_PI * Eigen::Vector3d(x.head<3>()).normalized();
    const Eigen::Isometry3d T = se3::exp(half);
    EXPECT_LT(difference(se3::exp(se3::log(T)), T), 1e-9);
    EXPECT_NEAR(se3::angle(T), M_PI, 1e-9);
  }
}

TEST(Se3, LogTakesShorterRotation) {
  Vector6d x = Vector6d::Zero();
  x(5) = M_PI + 0.5;
  EXPECT_NEAR(se3::log(se3::exp(x))(5), 0.5 - M_PI, 1e-12);
  EXPECT_NEAR(se3::angle(se3::exp(x)), M_PI - 0.5, 1e-12);
}

TEST(Se3, SatisfiesGroupLaws) {
  const auto all = tangents(300);
  for (std::size_t i = 0; i + 2 < all.size(); ++i) {
    const Eigen::Isometry3d a = se3::exp(all[i]);
    const Eigen::Isometry3d b = se3::exp(all[i + 1]);
    const Eigen::Isometry3d c = se3::exp(all[i + 2]);
    EXPECT_LT(difference((a * b) * c, a * (b * c)), 1e-13);
    EXPECT_LT(difference(a * a.inverse(), Eigen::Isometry3d::Identity()), 1e-13);
    EXPECT_LT(difference(se3::exp(-all[i]), a.inverse()), 1e-12);
  }
}

TEST(Se3, AdjointMovesPerturbationToLeft) {
  const auto all = tangents(300);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const Eigen::Isometry3d T = se3::exp(all[i]);
    const Vector6d x = all[i + 1];
    EXPECT_LT(difference(T * se3::exp(x), se3::exp(se3::adjoint(T) * x) * T), 1e-11);
  }
}

TEST(Se3, AdjointIsHomomorphism) {
  const auto all = tangents(100);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const Eigen::Isometry3d a = se3::exp(all[i]);
    const Eigen::Isometry3d b = se3::exp(all[i + 1]);
    EXPECT_LT((se3::adjoint(a * b) - se3::adjoint(a) * se3::adjoint(b)).norm(), 1e-12);
  }
}

TEST(Se3, InterpolatesAlongGeodesic) {
  for (const Vector6d& x : tangents(100)) {
    const Eigen::Isometry3d T = se3::exp(x);
    EXPECT_LT(difference(se3::interpolate(T, 0.0), Eigen::Isometry3d::Identity()), 1e-15);
    EXPECT_LT(difference(se3::interpolate(T, 1.0), T), 1e-9);
    const Eigen::Isometry3d half = se3::interpolate(T, 0.5);
    EXPECT_LT(difference(half * half, T), 1e-9);
    EXPECT_NEAR(se3::angle(half), 0.5 * x.tail<3>().norm(), 1e-9);
  }
}

TEST(Se3, NormalizedRestoresRotation) {
  for (const Vector6d& x : tangents(50)) {
    const Eigen::Isometry3d T = se3::exp(x);
    Eigen::Isometry3d drifted = T;
    drifted.linear() += 1e-7 * Eigen::Matrix3d::Ones();
    const Eigen::Isometry3d back = se3::normalized(drifted);
    EXPECT_LT(difference(back, T), 1e-6);
    EXPECT_LT((back.linear() * back.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-14);
    EXPECT_EQ(back.translation(), T.translation());
  }
}

}  // namespace
}  // namespace mms
