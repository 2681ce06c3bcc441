#include "mms/localization/motion/motion_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::motion;
using testing::position_error;

Timestamp at(double seconds) {
  return Timestamp::from_seconds(seconds);
}

/// Constant velocity of translation and rotation in the sensor's frame.
Eigen::Isometry3d steady(double seconds) {
  Vector6d velocity;
  velocity << 0.5, -0.2, 1.0, 0.1, 0.4, -0.3;
  return se3::exp(velocity * seconds);
}

TEST(MotionModel, PredictsConstantVelocity) {
  MotionModel model{MotionConfig{}};
  model.place(at(1.0), steady(0.0));
  model.measure(at(1.1), steady(0.1));
  EXPECT_TRUE(model.predict(at(1.35)).T_world_sensor.isApprox(steady(0.35), 1e-9));
  EXPECT_TRUE(model.predict(at(0.9)).T_world_sensor.isApprox(steady(-0.1), 1e-9));
}

TEST(MotionModel, ExtrapolatesAChangeOfVelocity) {
  MotionModel model{MotionConfig{}};
  const auto accelerated = [](double t) { return motion(0.5 * 2.0 * t * t, 0, 0, 0, 0, 0); };
  model.place(at(0.2), accelerated(0.2));
  EXPECT_NEAR(model.velocity_at(at(0.3), accelerated(0.3))[0], 0.5, 1e-9) << "of two poses";
  model.measure(at(0.3), accelerated(0.3));
  EXPECT_NEAR(model.velocity_at(at(0.5), accelerated(0.5))[0], 1.0, 1e-9);
  EXPECT_EQ(model.velocity_at(at(0.3), accelerated(0.5)), model.velocity());
}

TEST(MotionModel, IsUninformativeBeforeVelocityIsKnown) {
  MotionModel model{MotionConfig{}};
  model.place(at(0.0), steady(0.0));
  EXPECT_FALSE(model.predict(at(0.1)).is_informative());
  model.measure(at(0.1), steady(0.1));
  EXPECT_TRUE(model.predict(at(0.2)).is_informative());
}

/// From rest with an acceleration of one standard deviation, the true and the predicted position
/// differ by one standard deviation, without that of the measurements, 4/3.6 of it in 0.4 s.
TEST(MotionModel, ErrorEqualsThatOfAcceleration) {
  MotionConfig config;
  config.acceleration = 2.0;
  MotionModel model(config);
  const auto accelerated = [](double t) { return motion(0.5 * 2.0 * t * t, 0, 0, 0, 0, 0); };
  model.place(at(0.2), accelerated(0.2));
  model.measure(at(0.5), accelerated(0.5));
  const PosePrediction expected = model.predict(at(0.9));
  EXPECT_NEAR(position_error(expected.T_world_sensor, accelerated(0.9)),
              expected.translation_sigma - 0.003 * 4.0 / 3.6, 1e-9);
}

TEST(MotionModel, RecoversVelocityAfterCoasting) {
  MotionModel model{MotionConfig{}};
  model.place(at(0.0), steady(0.0));
  model.measure(at(0.1), steady(0.1));
  const double sigma = model.predict(at(0.2)).translation_sigma;
  for (double t = 0.2; t < 0.55; t += 0.1) model.coast(at(t));
  EXPECT_GT(model.predict(at(0.6)).translation_sigma, 5.0 * sigma);
  model.measure(at(0.6), steady(0.6));
  EXPECT_TRUE(model.predict(at(0.7)).T_world_sensor.isApprox(steady(0.7), 1e-9));
  EXPECT_GT(model.predict(at(0.7)).translation_sigma, 2.0 * sigma);
  EXPECT_LT(model.predict(at(0.7)).translation_sigma, 5.0 * sigma);
}

TEST(MotionModel, KeepsAVehicleFeasibleAfterOneLostScan) {
  const auto drive = [](double t) { return motion(20.0 * t, 0, 0, 0, 0, 0); };
  MotionModel model{MotionConfig{}};
  model.place(at(0.0), drive(0.0));
  model.measure(at(0.1), drive(0.1));
  model.coast(at(0.2));
  EXPECT_TRUE(model.is_feasible(at(0.3), drive(0.3)));
  EXPECT_LT(position_error(model.predict(at(0.3)).T_world_sensor, drive(0.3)), 0.15);
}

TEST(MotionModel, AcceptsAPoseAfterTwoFramesInQuickSuccession) {
  MotionModel model{MotionConfig{}};
  const auto at_rest = motion(0, 0, 0, 0, 0, 0);
  model.place(at(0.0), at_rest);
  model.measure(at(0.1), at_rest);
  model.measure(at(0.101), motion(0.002, 0, 0, 0, 0, 0));
  EXPECT_TRUE(model.is_feasible(at(0.201), at_rest));
  EXPECT_GT(model.predict(at(0.201)).translation_sigma, 0.1);
}

TEST(MotionModel, AcceptsPosesOfAFastVehicleWithInexactStamps) {
  MotionModel model{MotionConfig{}};
  const auto drive = [](double t) { return motion(20.0 * t, 0, 0, 0, 0, 0); };
  const auto stamp_of = [](int i) { return at(0.1 * i + (i % 2 == 0 ? 0.005 : -0.005) + 1.0); };
  model.place(stamp_of(0), drive(0.0));
  model.measure(stamp_of(1), drive(0.1));
  for (int i = 2; i < 20; ++i) {
    EXPECT_TRUE(model.is_feasible(stamp_of(i), drive(0.1 * i))) << i;
    model.measure(stamp_of(i), drive(0.1 * i));
  }
}

TEST(MotionModel, RefusesThatPeoplePullAPose) {
  MotionModel model{MotionConfig{}};
  const auto walk = [](double t) { return motion(1.5 * t, 0, 0, 0, 0, 0); };
  model.place(at(1.0), walk(0.0));
  model.measure(at(1.0 + 1.0 / 30.0), walk(1.0 / 30.0));
  const Eigen::Isometry3d pulled = walk(2.0 / 30.0) * motion(0.047, 0, 0, 0, 0, 0);
  EXPECT_FALSE(model.is_feasible(at(1.0 + 2.0 / 30.0), pulled));
}

TEST(MotionModel, ComesToRestWhileCoasting) {
  MotionModel model{MotionConfig{}};
  model.place(at(0.0), motion(0, 0, 0, 0, 0, 0));
  model.measure(at(0.1), motion(0.1, 0, 0, 0, 0, 0));
  for (int i = 2; i <= 30; ++i) model.coast(at(0.1 * i));
  const double kept = std::exp2(-0.1 * 15.0);  // of the velocity after each step
  EXPECT_NEAR(model.pose().translation().x(), 0.1 + 0.1 / (1.0 - kept), 1e-6);
  EXPECT_LT(model.velocity().norm(), 1e-6);
}

TEST(MotionModel, LosesVelocityAtTheSamePaceAtAnyFrameRate) {
  for (const int frames : {1, 2, 6}) {
    MotionModel model{MotionConfig{}};
    model.place(at(0.0), motion(0, 0, 0, 0, 0, 0));
    model.measure(at(0.1), motion(0.1, 0, 0, 0, 0, 0));
    for (int i = 1; i <= frames; ++i) model.coast(at(0.1 + 0.2 * i / frames));
    EXPECT_NEAR(model.velocity().norm(), std::exp2(-0.2 * 15.0), 1e-6) << frames;
  }
}

TEST(MotionModel, StaysFiniteWhenStampsGoBack) {
  MotionModel model{MotionConfig{}};
  model.place(at(1000.0), steady(0.0));
  model.measure(at(1000.1), steady(0.1));
  const double speed = model.velocity().norm();
  model.coast(at(0.0));
  EXPECT_LE(model.velocity().norm(), speed);
  model.coast(at(0.1));
  EXPECT_LT(model.velocity().norm(), speed);
  EXPECT_TRUE(model.pose().matrix().allFinite());
}

TEST(MotionModel, AcceptsPosesWithinAccelerationLimit) {
  MotionConfig config;
  config.max_acceleration = 10.0;
  MotionModel model(config);
  model.place(at(0.0), steady(0.0));
  model.measure(at(0.1), steady(0.1));
  const auto displaced = [](double metres) { return motion(metres, 0, 0, 0, 0, 0) * steady(0.2); };
  EXPECT_TRUE(model.is_feasible(at(0.2), displaced(0.10)));  // 0.01 + 10/2 * 0.1 * 0.2 = 0.11
  EXPECT_FALSE(model.is_feasible(at(0.2), displaced(0.12)));
  model.coast(at(0.2));
  EXPECT_TRUE(model.is_feasible(at(0.3), displaced(0.30)));  // the limit is 0.31
}

TEST(MotionModel, LimitsSpeedBeforeVelocityIsKnown) {
  MotionConfig config;
  config.max_speed = 2.0;
  config.max_turn_rate = 90.0;
  MotionModel model(config);
  model.place(at(0.0), motion(0, 0, 0, 0, 0, 0));
  EXPECT_TRUE(model.is_feasible(at(0.1), motion(0.19, 0, 0, 0, 0, 0)));
  EXPECT_FALSE(model.is_feasible(at(0.1), motion(0.21, 0, 0, 0, 0, 0)));
  EXPECT_TRUE(model.is_feasible(at(0.1), motion(0, 0, 0, 0, 0.15, 0)));
  EXPECT_FALSE(model.is_feasible(at(0.1), motion(0, 0, 0, 0, 0.17, 0)));
}

TEST(MotionModel, IsUninformativeWithoutAccelerations) {
  MotionConfig config;
  config.acceleration = 0.0;
  config.turn_acceleration = 0.0;
  MotionModel model(config);
  model.place(at(0.0), steady(0.0));
  model.measure(at(0.1), steady(0.1));
  EXPECT_FALSE(model.predict(at(0.2)).is_informative());
}

TEST(PosePrediction, GradientEqualsNumericDerivative) {
  const PosePrediction prediction{motion(1.0, 2.0, 3.0, 0.3, -0.2, 0.1), 0.02, 0.05};
  const Eigen::Isometry3d pose =
      prediction.T_world_sensor * motion(0.01, -0.02, 0.005, 0.004, 0.002, -0.003);
  const NormalEquations equations = prediction.equations(pose);
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = 1e-6 * Vector6d::Unit(i);
    const double difference = prediction.equations(pose * se3::exp(step)).cost -
                              prediction.equations(pose * se3::exp(-step)).cost;
    const double derivative = 0.25 * difference / 1e-6;  // of half the cost
    EXPECT_NEAR(derivative, equations.gradient(i), 0.01 * equations.gradient.norm()) << i;
  }
}

}  // namespace
}  // namespace mms
