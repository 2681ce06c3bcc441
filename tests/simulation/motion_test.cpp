#include "mms/simulation/world/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mms/simulation/world/route.hpp"

namespace mms {
namespace {

Route square() {
  Route route;
  route.corners = {{0.0, 0.0}, {8.0, 0.0}, {8.0, 6.0}, {0.0, 6.0}};
  route.end = RouteEnd::kLoop;
  route.speed = 1.2;
  return route;
}

TEST(Motion, VelocityIsDerivativeOfPosition) {
  const Motion motion = drive(square(), 20.0);
  constexpr double kStep = 1e-5;
  for (double t = 0.013; t < 20.0; t += 0.371) {
    const Eigen::Vector2d slope =
        (motion.position(t + kStep) - motion.position(t - kStep)) / (2.0 * kStep);
    EXPECT_NEAR((slope - motion.velocity(t)).norm(), 0.0, 1e-6) << t;
  }
}

TEST(Motion, IsStaticBeforeAndAfter) {
  const Motion motion = drive(square(), 5.0);
  EXPECT_NEAR((motion.position(-3.0) - motion.position(-1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((motion.position(50.0) - motion.position(90.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(motion.velocity(-3.0).norm(), 0.0, 1e-12);
  EXPECT_NEAR(motion.velocity(50.0).norm(), 0.0, 1e-12);
}

TEST(Motion, StillMotionNeverMoves) {
  const Motion motion = Motion::still({1.0, 2.0}, 0.5);
  for (const double t : {-1.0, 0.0, 0.7, 100.0}) {
    EXPECT_NEAR((motion.position(t) - Eigen::Vector2d(1.0, 2.0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(motion.yaw(t), 0.5, 1e-12);
    EXPECT_NEAR(motion.velocity(t).norm(), 0.0, 1e-12);
  }
}

TEST(Route, KeepsToLinesAndSpeed) {
  const Motion motion = drive(square(), 40.0);
  for (double t = 0.0; t < 40.0; t += 0.1) {
    const Eigen::Vector2d p = motion.position(t);
    const double outside = std::max({-p.x(), p.x() - 8.0, -p.y(), p.y() - 6.0});
    const double inside = std::min({p.x(), 8.0 - p.x(), p.y(), 6.0 - p.y()});
    EXPECT_LT(outside, 0.3) << t;
    EXPECT_LT(inside, 0.5) << t;
    EXPECT_LT(motion.velocity(t).norm(), 1.25) << t;
  }
}

TEST(Route, TravelledIsPathLength) {
  const Motion motion = drive(square(), 20.0);
  double length = 0.0;
  for (double t = 0.0; t < 20.0; t += 0.01) {
    length += (motion.position(t + 0.01) - motion.position(t)).norm();
  }
  EXPECT_NEAR(motion.travelled(20.0) - motion.travelled(0.0), length, 0.02 * length);
}

TEST(Route, DrivesToAndFro) {
  Route route;
  route.corners = {{0.0, 0.0}, {4.0, 0.0}};
  route.end = RouteEnd::kToAndFro;
  const Motion motion = drive(route, 60.0);
  double min_x = 9.0;
  double max_x = -9.0;
  int turns = 0;
  double before = 1.0;
  for (double t = 0.0; t < 60.0; t += 0.1) {
    min_x = std::min(min_x, motion.position(t).x());
    max_x = std::max(max_x, motion.position(t).x());
    EXPECT_LT(std::abs(motion.position(t).y()), 0.6);
    const double v = motion.velocity(t).x();
    if (std::abs(v) > 0.5 && v * before < 0.0) {
      ++turns;
      before = v;
    }
  }
  EXPECT_NEAR(min_x, 0.0, 0.5);
  EXPECT_NEAR(max_x, 4.0, 0.5);
  EXPECT_GE(turns, 6);
}

TEST(Route, StopsAtItsEnd) {
  Route route;
  route.corners = {{0.0, 0.0}, {3.0, 0.0}};
  const Motion motion = drive(route, 30.0);
  EXPECT_NEAR((motion.position(29.0) - Eigen::Vector2d(3.0, 0.0)).norm(), 0.0, 0.25);
  EXPECT_LT(motion.velocity(29.0).norm(), 0.01);
}

TEST(Route, PausesForShareOfTime) {
  Route route = square();
  route.pause_share = 0.4;
  route.pause = 4.0;
  route.seed = 5;
  const double seconds = 600.0;
  const Motion motion = drive(route, seconds);
  int standing = 0;
  int all = 0;
  for (double t = 0.0; t < seconds; t += 0.1) {
    ++all;
    standing += motion.velocity(t).norm() < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(standing) / all, 0.4, 0.1);
}

TEST(Route, StartsAtGivenDistance) {
  Route route = square();
  route.start = 10.0;
  EXPECT_NEAR((drive(route, 1.0).position(0.0) - Eigen::Vector2d(8.0, 2.0)).norm(), 0.0, 0.05);
  EXPECT_NEAR(length_of(route), 28.0, 1e-9);
}

}  // namespace
}  // namespace mms
