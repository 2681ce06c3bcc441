#include "mms/mapping/motion_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

const Eigen::Vector3d kUp(0, 0, 1);

TEST(MotionFilter, FollowsASteadyPointExactlyInTheEnd) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.2, 1.0);
  const Eigen::Vector3d velocity(1.0, -0.5, 0.0);
  for (int i = 1; i <= 300; ++i) {
    filter.predict(1.0 / 30.0, 0.1);
    filter.update(velocity * (i / 30.0), {0.05});
  }
  EXPECT_TRUE(filter.velocity().isApprox(velocity, 1e-3));
  EXPECT_TRUE(filter.position().isApprox(10.0 * velocity, 1e-4));
}

TEST(MotionFilter, TwoShortStepsAreOneLongOne) {
  MotionFilter once(Eigen::Vector3d(1, 2, 3), kUp, 0.1, 0.5);
  MotionFilter twice = once;
  once.predict(0.4, 0.2);
  twice.predict(0.1, 0.2);
  twice.predict(0.3, 0.2);
  EXPECT_TRUE(once.position_covariance().isApprox(twice.position_covariance(), 1e-12));
  EXPECT_TRUE(once.velocity_covariance().isApprox(twice.velocity_covariance(), 1e-12));
}

TEST(MotionFilter, ItsCovarianceIsHonest) {
  // White noise of the measurements: errors are within three sigma nearly always.
  RandomStream random(5);
  const double sigma = 0.05;
  int outside = 0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.05, 1.0);
    for (int i = 1; i <= 60; ++i) {
      filter.predict(1.0 / 30.0, 1e-4);
      Eigen::Vector3d noise;
      for (double& value : noise) {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) sum += static_cast<double>(random.uniform());
        value = sigma * sum;
      }
      filter.update(Eigen::Vector3d(i / 30.0, 0, 0) + noise, {sigma});
    }
    const double error = filter.velocity().x() - 1.0;
    if (std::abs(error) > 3.0 * std::sqrt(filter.velocity_covariance()(0, 0))) ++outside;
  }
  EXPECT_LT(outside, runs / 25);
}

TEST(MotionFilter, WhatComesIntoViewDoesNotRise) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
  for (int i = 1; i <= 60; ++i) {
    filter.predict(1.0 / 30.0, 0.1);
    filter.update({0.0, 0.0, std::min(1.0, 0.05 * i)}, {0.05});
  }
  EXPECT_NEAR(filter.velocity().norm(), 0.0, 1e-9);
  EXPECT_NEAR(filter.position().z(), 1.0, 0.02);
}

TEST(MotionFilter, AJumpCountsLittle) {
  // By how much one measurement that is so far off [m] changes the velocity.
  const auto effect_of = [](double off) {
    MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
    for (int i = 1; i <= 61; ++i) {
      filter.predict(1.0 / 30.0, 0.1);
      filter.update({i / 30.0 + (i == 61 ? off : 0.0), 0.0, 0.0}, {0.03});
    }
    return filter.velocity().x() - 1.0;
  };
  EXPECT_NEAR(effect_of(0.04), 2.0 * effect_of(0.02), 1e-3);
  EXPECT_LT(effect_of(1.0), 3.0 * effect_of(0.1));
}

/// Largest error of the velocity of a point at 1 m/s whose measured place is off by 0.3 m in some
/// of its 75 frames, from frame 15 on.
double worst_velocity(int off_begin, int off_end, const PositionError& error_while_off) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.3, 0.7);
  double worst = 0.0;
  for (int i = 1; i <= 75; ++i) {
    filter.predict(1.0 / 15.0, 0.2);
    const bool is_off = i >= off_begin && i < off_end;
    filter.update({i / 15.0 + (is_off ? 0.3 : 0.0), 0.0, 0.0},
                  is_off ? error_while_off : PositionError{0.03, 0.0});
    if (i >= 15) worst = std::max(worst, std::abs(filter.velocity().x() - 1.0));
  }
  return worst;
}

TEST(MotionFilter, AnOffsetThatComesAndGoesIsNoMotion) {
  EXPECT_LT(worst_velocity(30, 45, {0.03, 0.3}), 0.2);
  EXPECT_GT(worst_velocity(30, 45, {0.03, 0.0}), 0.6);
}

TEST(MotionFilter, AnOffsetFromTheBeginningIsNoMotionEither) {
  EXPECT_LT(worst_velocity(0, 25, {0.03, 0.3}), 0.3);
  EXPECT_GT(worst_velocity(0, 25, {0.03, 0.0}), 0.6);
}

TEST(MotionFilter, TheWholeInViewEndsTheDoubtAboutThePlace) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.3, 0.7);
  for (int i = 1; i <= 30; ++i) {
    filter.predict(1.0 / 15.0, 0.2);
    filter.update({0.3, 0.0, 0.0}, {0.03, 0.3});
  }
  EXPECT_GT(filter.position_covariance()(0, 0), 0.1 * 0.1);
  filter.predict(1.0 / 15.0, 0.2);
  filter.update({0.0, 0.0, 0.0}, {0.03, 0.0});
  EXPECT_LT(filter.position_covariance()(0, 0), 0.03 * 0.03);
  EXPECT_NEAR(filter.position().x(), 0.0, 0.03);
}

TEST(MotionFilter, AShiftIsNoMotion) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
  filter.shift({0.5, 0.0, 0.0});
  EXPECT_EQ(filter.position().x(), 0.5);
  EXPECT_EQ(filter.velocity().norm(), 0.0);
}

TEST(MotionFilter, AnotherUpLeavesNoVelocityAlongIt) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.01, 10.0);
  filter.predict(1.0, 0.1);
  filter.update({1.0, 0.0, 0.0}, {0.001});
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  filter.set_up(up);
  EXPECT_NEAR(filter.velocity().dot(up), 0.0, 1e-12);
  EXPECT_NEAR(up.dot(filter.velocity_covariance() * up), 0.0, 1e-12);
  EXPECT_NEAR(filter.velocity().norm(), 1.0, 0.02);
}

TEST(MotionFilter, LimitsTheSpeedButNotTheDirection) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.01, 100.0);
  filter.predict(1.0, 0.1);
  filter.update({3.0, 4.0, 0.0}, {0.001});
  filter.limit_speed(2.5);
  EXPECT_NEAR(filter.velocity().norm(), 2.5, 1e-9);
  EXPECT_NEAR(filter.velocity().y() / filter.velocity().x(), 4.0 / 3.0, 1e-6);
}

}  // namespace
}  // namespace mms
