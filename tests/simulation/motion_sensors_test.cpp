#include "mms/simulation/sensors/motion_sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mms/geometry/se3.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

/// A base on a circle of 2 m, 0.5 m/s.
Eigen::Isometry3d circle(double t) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double angle = 0.25 * t;
  pose.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = 2.0 * Eigen::Vector3d(std::sin(angle), 1.0 - std::cos(angle), 0.0);
  return pose;
}

WheelConfig exact_wheels() {
  WheelConfig config;
  config.enabled = true;
  config.scale_error = config.turn_error = config.noise = config.turn_noise = 0.0;
  return config;
}

ImuConfig exact_imu() {
  ImuConfig config;
  config.enabled = true;
  config.noise = config.bias = config.bias_walk = config.scale_error = config.acceleration_noise =
      0.0;
  return config;
}

double way_of(const std::vector<WheelSample>& samples, double from, double to) {
  double way = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].stamp.seconds() <= from || samples[i].stamp.seconds() > to + 1e-9) continue;
    way += (samples[i].T_odom_base.translation() - samples[i - 1].T_odom_base.translation()).norm();
  }
  return way;
}

TEST(MotionSensors, ExactWheelsFollowTheBase) {
  const auto samples = measure_wheels(circle, 10.0, exact_wheels(), 1);
  ASSERT_EQ(samples.size(), 501U);
  for (const WheelSample& sample : samples) {
    const Eigen::Isometry3d truth = circle(sample.stamp.seconds());
    EXPECT_TRUE(sample.T_odom_base.isometry().isApprox(truth, 1e-9)) << sample.stamp.seconds();
  }
}

TEST(MotionSensors, ScaleErrorHasItsSize) {
  WheelConfig config = exact_wheels();
  config.scale_error = 0.02;
  const double way = way_of(measure_wheels(circle, 10.0, config, 3), 0.0, 10.0);
  EXPECT_NEAR(std::abs(way / 5.0 - 1.0), 0.02, 1e-3);
}

TEST(MotionSensors, SlipExceedsTheWayForItsTime) {
  WheelConfig config = exact_wheels();
  config.slip = 0.3;
  config.slip_from = 4.0;
  config.slip_for = 2.0;
  const auto samples = measure_wheels(circle, 10.0, config, 1);
  EXPECT_NEAR(way_of(samples, 0.0, 4.0), 2.0, 1e-3);
  EXPECT_NEAR(way_of(samples, 4.0, 6.0), 1.3, 1e-3);
  EXPECT_NEAR(way_of(samples, 6.0, 10.0), 2.0, 1e-3);
}

TEST(MotionSensors, WheelFaults) {
  WheelConfig config = exact_wheels();
  config.faults.stuck_from = 3.0;
  config.faults.delay = 0.02;
  const auto samples = measure_wheels(circle, 10.0, config, 1);
  EXPECT_EQ(samples.front().stamp.nanoseconds(), 20'000'000);
  EXPECT_TRUE(samples.back().T_odom_base.isometry().isApprox(circle(3.0), 1e-9));
  config.faults = {};
  config.faults.mounting_error = 5.0;
  const auto turned = measure_wheels(circle, 0.02, config, 1);
  const Eigen::Vector3d step = turned.back().T_odom_base.translation();
  EXPECT_NEAR(std::atan2(step.y(), step.x()) * 180.0 / M_PI, 5.0, 0.3);
}

TEST(MotionSensors, ExactGyroscopeAndAccelerometer) {
  const auto samples = measure_imu(circle, 4.0, exact_imu(), 1);
  ASSERT_EQ(samples.size(), 801U);
  const double centripetal = 2.0 * 0.25 * 0.25;
  for (std::size_t i = 10; i < samples.size(); ++i) {
    EXPECT_TRUE(samples[i].rate.isApprox(Eigen::Vector3d(0, 0, 0.25), 1e-6));
    EXPECT_TRUE(samples[i].acceleration.isApprox(Eigen::Vector3d(0, centripetal, 9.81), 1e-4));
  }
}

TEST(MotionSensors, NoiseAndBiasHaveTheirSize) {
  ImuConfig config = exact_imu();
  config.noise = 1e-3;
  config.bias = 0.02;
  const auto samples =
      measure_imu([](double) { return Eigen::Isometry3d::Identity(); }, 20.0, config, 5);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : samples) mean += sample.rate;
  mean /= static_cast<double>(samples.size());
  double square = 0.0;
  for (const ImuSample& sample : samples) square += (sample.rate - mean).squaredNorm() / 3.0;
  EXPECT_NEAR(mean.norm(), 0.02, 1e-3);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(samples.size())), 1e-3 * std::sqrt(200.0),
              1e-3);
}

TEST(MotionSensors, SeedDeterminesErrors) {
  WheelConfig config;
  config.enabled = true;
  const auto last = [&](std::uint64_t seed) {
    return measure_wheels(circle, 5.0, config, seed).back().T_odom_base.translation();
  };
  EXPECT_EQ(last(7), last(7));
  EXPECT_NE(last(7), last(8));
}

TEST(MotionSensors, SceneWithoutThemHasNone) {
  EXPECT_TRUE(SimulatedScene(scene_config("static")).motion().empty());
}

/// The base does not shake with the camera: 2 mm, 3 mrad and their lever arm.
TEST(MotionSensors, SceneWheelsFollowTheCamera) {
  SceneConfig config = scene_config("static");
  config.wheels = exact_wheels();
  const SimulatedScene scene(config);
  const MotionSamples samples = scene.motion();
  const Eigen::Isometry3d T_sensor_base = scene.calibration().motion.T_sensor_base->isometry();
  for (std::size_t i = 100; i < samples.wheels.size(); i += 100) {
    const WheelSample& now = samples.wheels[i];
    const Eigen::Isometry3d step =
        samples.wheels[i - 50].T_odom_base.isometry().inverse() * now.T_odom_base.isometry();
    const Eigen::Isometry3d sensed = T_sensor_base * step * T_sensor_base.inverse();
    const Eigen::Isometry3d truth =
        scene.pose_at(samples.wheels[i - 50].stamp).T_world_sensor.isometry().inverse() *
        scene.pose_at(now.stamp).T_world_sensor.isometry();
    EXPECT_LT((sensed.inverse() * truth).translation().norm(), 0.012) << i;
    EXPECT_LT(se3::angle(sensed.inverse() * truth), 0.02) << i;
  }
}

}  // namespace
}  // namespace mms
