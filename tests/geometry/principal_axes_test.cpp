#include "mms/geometry/principal_axes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

namespace mms {
namespace {

constexpr EigenMethod kMethods[] = {EigenMethod::kIterative, EigenMethod::kClosedForm};

/// Points at +-1, +-2 and +-3 on the axes x, z and y.
std::vector<Eigen::Vector3d> cross(const Eigen::Vector3d& center) {
  std::vector<Eigen::Vector3d> points;
  for (const double sign : {-1.0, 1.0}) {
    points.push_back(center + Eigen::Vector3d(sign, 0.0, 0.0));
    points.push_back(center + Eigen::Vector3d(0.0, 0.0, 2.0 * sign));
    points.push_back(center + Eigen::Vector3d(0.0, 3.0 * sign, 0.0));
  }
  return points;
}

PointSums<double, 3> sums_of(const std::vector<Eigen::Vector3d>& points) {
  PointSums<double, 3> sums;
  for (const Eigen::Vector3d& point : points) sums.add(point);
  return sums;
}

TEST(PointSums, GivesMeanAndCovariance) {
  const PointSums<double, 3> sums = sums_of(cross({1.0, 2.0, 3.0}));
  EXPECT_EQ(sums.count(), 6);
  EXPECT_EQ(sums.weight(), 6.0);
  EXPECT_TRUE(sums.mean().isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
  const Eigen::Matrix3d expected = Eigen::Vector3d(1.0, 9.0, 4.0).asDiagonal();
  EXPECT_TRUE(sums.covariance().isApprox(expected / 3.0, 1e-12));
}

TEST(PointSums, WeightCountsAsRepetition) {
  PointSums<double, 2> weighted, repeated;
  weighted.add({1.0, 2.0}, 3.0);
  weighted.add({-4.0, 1.0}, 1.0);
  for (int i = 0; i < 3; ++i) repeated.add({1.0, 2.0});
  repeated.add({-4.0, 1.0});
  EXPECT_EQ(weighted.count(), 2);
  EXPECT_TRUE(weighted.mean().isApprox(repeated.mean(), 1e-15));
  EXPECT_TRUE(weighted.covariance().isApprox(repeated.covariance(), 1e-15));
}

TEST(ScatterOf, IsExactFarFromOrigin) {
  const Eigen::Vector3d center(1e6, -2e6, 3e6);
  const auto scatter = scatter_of(cross(center));
  EXPECT_EQ(scatter.mean, center);
  const Eigen::Matrix3d expected = Eigen::Vector3d(2.0, 18.0, 8.0).asDiagonal();
  EXPECT_EQ(scatter.matrix, expected);
}

TEST(ScatterOf, ReadsMembers) {
  struct Item {
    int index;
    Eigen::Vector2f position;
  };
  const std::vector<Item> items = {{0, {1.0F, 0.0F}}, {1, {3.0F, 0.0F}}};
  const auto scatter = scatter_of(items, &Item::position);
  EXPECT_EQ(scatter.mean, Eigen::Vector2f(2.0F, 0.0F));
  EXPECT_EQ(scatter.matrix(0, 0), 2.0F);
}

TEST(PrincipalAxes, AreAxesOfCross) {
  for (const EigenMethod method : kMethods) {
    const auto axes = principal_axes(sums_of(cross(Eigen::Vector3d::Zero())).covariance(), method);
    EXPECT_TRUE(axes.variances.isApprox(Eigen::Vector3d(1.0, 4.0, 9.0) / 3.0, 1e-9));
    EXPECT_NEAR(std::abs(axes.smallest().x()), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(axes.axes(2, 1)), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(axes.largest().y()), 1.0, 1e-9);
  }
}

TEST(PrincipalAxes, SmallestAxisIsPlaneNormal) {
  PointSums<float, 3> sums;
  for (float x = -2.0F; x <= 2.0F; ++x) {
    for (float y = -1.0F; y <= 1.0F; ++y) sums.add({x, y, 0.5F * x});
  }
  for (const EigenMethod method : kMethods) {
    const auto axes = principal_axes(sums.covariance(), method);
    EXPECT_NEAR(axes.variances(0), 0.0F, 1e-6F);
    const Eigen::Vector3f normal = Eigen::Vector3f(-0.5F, 0.0F, 1.0F).normalized();
    EXPECT_NEAR(std::abs(axes.smallest().dot(normal)), 1.0F, 1e-5F);
  }
}

TEST(PrincipalAxes, RotateWithPoints) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d R =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized()
            .toRotationMatrix();
    std::vector<Eigen::Vector3d> points, rotated;
    for (int i = 0; i < 200; ++i) {
      points.emplace_back(normal(random), 2.0 * normal(random), 4.0 * normal(random));
      rotated.push_back(R * points.back());
    }
    const Scatter<double, 3> before = scatter_of(points);
    const Scatter<double, 3> after = scatter_of(rotated);
    EXPECT_TRUE(after.mean.isApprox(R * before.mean, 1e-12));
    for (const EigenMethod method : kMethods) {
      const auto expected = principal_axes(before.matrix, method);
      const auto axes = principal_axes(after.matrix, method);
      EXPECT_TRUE(axes.variances.isApprox(expected.variances, 1e-9));
      const Eigen::Matrix3d alignment = axes.axes.transpose() * R * expected.axes;
      EXPECT_TRUE(alignment.cwiseAbs().isApprox(Eigen::Matrix3d::Identity(), 1e-6)) << alignment;
    }
  }
}

TEST(Oriented, PointsAlongDirection) {
  const Eigen::Vector3f axis(0.0F, 0.6F, 0.8F);
  const Eigen::Vector3f opposite = -axis;
  EXPECT_EQ(oriented(axis, {5.0F, 1.0F, 0.0F}), axis);
  EXPECT_EQ(oriented(axis, {5.0F, -1.0F, 0.0F}), opposite);
  EXPECT_EQ(oriented(axis, {5.0F, 0.0F, 0.0F}), axis);
}

}  // namespace
}  // namespace mms
