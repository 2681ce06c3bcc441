#include "mms/mapping/tracking/box_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mms {
namespace {

const GroundFrame kGround(Eigen::Vector3d(0, -1, 0));
const Eigen::Vector3d kSize(1.4, 0.8, 1.2);

/// The points of an upright box's faces that a sensor at the origin sees.
ObjectMeasurement view_of(const Eigen::Vector3d& center, double heading) {
  ObjectMeasurement object;
  object.object_class = ObjectClass::kAgv;
  const Eigen::Matrix3d axes = kGround.axes(heading);
  const Eigen::Vector3d sensor = axes.transpose() * (-center);
  constexpr int kSteps = 14;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(sensor[k]) <= 0.5 * kSize[k]) continue;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        Eigen::Vector3d local;
        local[k] = std::copysign(0.5 * kSize[k], sensor[k]);
        local[(k + 1) % 3] = kSize[(k + 1) % 3] * (static_cast<double>(i) / kSteps - 0.5);
        local[(k + 2) % 3] = kSize[(k + 2) % 3] * (static_cast<double>(j) / kSteps - 0.5);
        object.points.emplace_back(center + axes * local);
      }
    }
  }
  for (const auto& point : object.points) {
    object.centroid += point / static_cast<double>(object.points.size());
  }
  return object;
}

/// Removes the points beyond x, as the image's right border does.
ObjectMeasurement truncated_right(ObjectMeasurement object, double x) {
  std::erase_if(object.points, [x](const Eigen::Vector3d& point) { return point.x() > x; });
  object.truncation.right = true;
  return object;
}

TEST(GroundFrame, AxesAreRightHandedWithHeading) {
  for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0.1, -2, 0.3),
                                    Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0.2, 5)}) {
    const GroundFrame ground(up);
    for (double heading = -3.0; heading < 3.0; heading += 0.7) {
      const Eigen::Matrix3d axes = ground.axes(heading);
      EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-12));
      EXPECT_NEAR(axes.determinant(), 1.0, 1e-12);
      EXPECT_NEAR(axes.col(2).dot(up.normalized()), 1.0, 1e-12);
      EXPECT_NEAR(ground.heading_of(axes.col(0)), heading, 1e-12);
    }
  }
}

TEST(BoxFit, FindsCenterFromAnySide) {
  for (double heading = 0.0; heading < 6.2; heading += 0.13) {
    const Eigen::Vector3d center(0.4, 0.3, 4.0);
    const BoxFit fit = fit_box(view_of(center, heading), kGround, heading, kSize);
    EXPECT_LT((fit.center - center).norm(), 0.06) << heading;
    EXPECT_TRUE(fit.anchored);
  }
}

TEST(BoxFit, ExtendsToFloorWhenBottomIsHidden) {
  const Eigen::Vector3d center(0.4, 0.3, 4.0);  // bottom at y = 0.9
  ObjectMeasurement object = view_of(center, 0.4);
  std::erase_if(object.points, [](const Eigen::Vector3d& point) { return point.y() > 0.3; });
  object.truncation.bottom = true;
  const GroundFrame with_floor(kGround.up(), -0.9);
  const BoxFit fit = fit_box(object, with_floor, 0.4, kSize);
  EXPECT_NEAR(fit.center.y(), 0.3, 0.03);
  EXPECT_TRUE(fit.whole[2]);
  EXPECT_NEAR(fit.extent.z(), kSize.z(), 0.05);
  EXPECT_FALSE(fit_box(object, kGround, 0.4, kSize).whole[2]);
}

TEST(BoxFit, DoesNotExtendToDistantFloor) {
  const GroundFrame low_floor(kGround.up(), -3.0);
  const Eigen::Vector3d center(0.4, 0.3, 4.0);
  const BoxFit fit = fit_box(view_of(center, 0.4), low_floor, 0.4, kSize);
  EXPECT_NEAR(fit.center.y(), 0.3, 0.03);
}

TEST(BoxFit, FrontViewHasWholeWidthAndHeightOnly) {
  const BoxFit fit = fit_box(view_of({0, 0.3, 4}, 0.0), kGround, 0.0, kSize);
  EXPECT_FALSE(fit.whole[0]);
  EXPECT_TRUE(fit.whole[1]);
  EXPECT_TRUE(fit.whole[2]);
  EXPECT_NEAR(fit.extent.y(), kSize.y(), 0.05);
}

TEST(BoxFit, CompletesTruncatedEndFromSize) {
  const double heading = 0.5 * std::numbers::pi;  // across the view
  const Eigen::Vector3d center(0.5, 0.3, 4.0);
  const BoxFit fit =
      fit_box(truncated_right(view_of(center, heading), 0.4), kGround, heading, kSize);
  EXPECT_LT((fit.center - center).norm(), 0.06);
  EXPECT_FALSE(fit.whole[0]);
  EXPECT_TRUE(fit.anchored);
}

TEST(BoxFit, IsUnanchoredWithBothEndsTruncated) {
  ObjectMeasurement object = view_of({0.0, 0.3, 2.0}, 0.0);
  object.truncation.left = object.truncation.right = true;
  EXPECT_FALSE(fit_box(object, kGround, 0.0, {2.0, 2.0, 2.0}).anchored);
}

TEST(RectangleHeading, MatchesSidesUpToQuarterTurns) {
  const double quarter = 0.5 * std::numbers::pi;
  for (double heading = 0.1; heading < 6.2; heading += 0.31) {
    const double found = rectangle_heading(view_of({0.6, 0.3, 4.0}, heading), kGround);
    const double error = std::remainder(found - heading, quarter);
    EXPECT_LT(std::abs(error), 0.06) << heading;
  }
}

}  // namespace
}  // namespace mms
