#include "mms/localization/motion/sensed_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "mms/localization/motion/motion_model.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::motion;
using testing::position_error;

constexpr double kDegree = M_PI / 180.0;

Timestamp at(double seconds) {
  return Timestamp::from_seconds(seconds);
}

/// A base that drives at 1 m/s and turns to the left and right.
Eigen::Isometry3d T_odom_base(double t) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(t, 0.3 * std::sin(1.5 * t), 0.0);
  pose.linear() =
      Eigen::AngleAxisd(0.6 * std::sin(2.0 * t), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

/// A camera on the base.
Eigen::Isometry3d T_sensor_base() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.translation() = Eigen::Vector3d(0.05, 1.0, -0.2);
  return T;
}

Eigen::Isometry3d T_sensor_imu() {
  return motion(0.01, 0.02, 0.0, 0.3, -0.2, 1.2);
}

Eigen::Isometry3d T_world_sensor(double t) {
  return T_sensor_base() * T_odom_base(t) * T_sensor_base().inverse();
}

Eigen::Isometry3d true_motion(double from, double to) {
  return T_world_sensor(from).inverse() * T_world_sensor(to);
}

MotionCalibration calibration() {
  MotionCalibration known;
  known.T_sensor_base = Transform<Sensor, Base>(T_sensor_base());
  known.T_sensor_imu = Transform<Sensor, Imu>(T_sensor_imu());
  return known;
}

std::vector<WheelSample> wheels_until(double end,
                                      const std::function<Eigen::Isometry3d(double)>& pose) {
  std::vector<WheelSample> samples;
  for (int i = 0; i <= std::lround(50.0 * end); ++i) {
    samples.push_back({at(0.02 * i), Transform<Odometer, Base>(pose(0.02 * i))});
  }
  return samples;
}

/// Rates of a perfect gyroscope.
Eigen::Vector3d rate_of(double t) {
  constexpr double h = 1e-4;
  const Eigen::Vector3d rate = se3::log(true_motion(t - h, t + h)).tail<3>() / (2.0 * h);
  return T_sensor_imu().linear().transpose() * rate;
}

std::vector<ImuSample> rates_until(double end,
                                   const std::function<Eigen::Vector3d(double)>& rate = rate_of) {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= std::lround(200.0 * end); ++i) {
    samples.push_back({at(0.005 * i), rate(0.005 * i), Eigen::Vector3d::Zero()});
  }
  return samples;
}

/// Compares with the true poses of a camera of 20 Hz.
void compare_until(MotionSensors& sensors, double from, double to) {
  for (double t = from; t < to - 1e-6; t += 0.05) sensors.compare(at(t), T_world_sensor(t), true);
}

std::string warnings_of(MotionSensors& sensors) {
  std::string text;
  for (const std::string& warning : sensors.take_warnings()) text += warning + "\n";
  return text;
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(SensedMotion, WheelsGiveMotionInSensorFrame) {
  MotionSensors sensors({});
  sensors.add({wheels_until(3.0, T_odom_base), {}}, calibration(), true);
  for (const auto& [from, to] : {std::pair(0.1, 0.17), {0.5, 2.5}, {1.3, 1.1}}) {
    const auto sensed = sensors.between(at(from), at(to));
    ASSERT_TRUE(sensed);
    EXPECT_TRUE(sensed->has_translation);
    EXPECT_LT(position_error(sensed->T_from_to, true_motion(from, to)), 1e-3) << from;
    EXPECT_LT(se3::angle(sensed->T_from_to.inverse() * true_motion(from, to)), 1e-3) << from;
  }
}

TEST(SensedMotion, UncertaintyGrowsWithWayAndTurn) {
  MotionSensors sensors({});
  sensors.add({wheels_until(3.0, T_odom_base), {}}, calibration(), true);
  const auto second = sensors.between(at(1.0), at(2.0));
  const double way = 1.07;  // of the sine of 0.3 m and 1.5 rad/s along one meter, within a tenth
  EXPECT_NEAR(second->translation_sigma, std::hypot(0.002, 0.02 * way), 0.002);
  EXPECT_GT(second->rotation_sigma, 0.1 * kDegree);
  EXPECT_NEAR(sensors.between(at(1.0), at(1.0))->translation_sigma, 0.002, 1e-9);
}

TEST(SensedMotion, SaysNothingOutsideAndAcrossGaps) {
  MotionSensors sensors({});
  EXPECT_TRUE(sensors.empty());
  std::vector<WheelSample> samples = wheels_until(1.0, T_odom_base);
  sensors.add({samples, {}}, calibration(), true);
  EXPECT_FALSE(sensors.between(at(0.5), at(1.2)));
  EXPECT_FALSE(sensors.between(at(-0.1), at(0.5)));
  EXPECT_TRUE(sensors.between(at(0.5), at(1.05)));  // shortly after the last one
  for (WheelSample& sample : samples) sample.stamp = sample.stamp + std::chrono::milliseconds(1500);
  sensors.add({samples, {}}, calibration(), true);
  EXPECT_FALSE(sensors.between(at(0.5), at(2.0)));
  EXPECT_TRUE(sensors.between(at(1.6), at(2.4)));
}

TEST(SensedMotion, GyroscopeIntegratesTurns) {
  MotionSensors sensors({});
  sensors.add({{}, rates_until(3.0)}, calibration(), true);
  const auto sensed = sensors.between(at(0.33), at(2.71));
  ASSERT_TRUE(sensed);
  EXPECT_FALSE(sensed->has_translation);
  EXPECT_LT(se3::angle(sensed->T_from_to.inverse() * true_motion(0.33, 2.71)), 1e-3);
}

TEST(SensedMotion, BiasIsEstimated) {
  const Eigen::Vector3d bias(0.01, -0.015, 0.008);
  MotionSensors sensors({});
  sensors.add(
      {{}, rates_until(12.0, [&](double t) -> Eigen::Vector3d { return rate_of(t) + bias; })},
      calibration(), true);
  const double before = se3::angle(sensors.between(at(10.0), at(11.0))->T_from_to.inverse() *
                                   true_motion(10.0, 11.0));
  const double sigma_before = sensors.between(at(10.0), at(11.0))->rotation_sigma;
  compare_until(sensors, 0.0, 10.0);
  const auto after = sensors.between(at(10.0), at(11.0));
  EXPECT_GT(before, 0.015);
  EXPECT_LT(se3::angle(after->T_from_to.inverse() * true_motion(10.0, 11.0)), 0.1 * before);
  EXPECT_LT(after->rotation_sigma, sigma_before);
  EXPECT_EQ(warnings_of(sensors), "");
}

TEST(SensedMotion, GyroscopeCorrectsHeadingOfWheels) {
  const auto turning_too_far = [](double t) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d before = T_odom_base(0.0);
    for (double at = 0.02; at <= t + 1e-9; at += 0.02) {
      Vector6d step = se3::log(before.inverse() * T_odom_base(at));
      step(5) += 0.1 * 0.02;
      pose = pose * se3::exp(step);
      before = T_odom_base(at);
    }
    return pose;
  };
  MotionSensors wheels({});
  wheels.add({wheels_until(3.0, turning_too_far), {}}, calibration(), true);
  MotionSensors both({});
  both.add({wheels_until(3.0, turning_too_far), rates_until(3.0)}, calibration(), true);
  compare_until(both, 0.0, 0.5);
  const Eigen::Isometry3d truth = true_motion(1.0, 2.5);
  const double alone = position_error(wheels.between(at(1.0), at(2.5))->T_from_to, truth);
  EXPECT_GT(alone, 0.08);
  EXPECT_LT(position_error(both.between(at(1.0), at(2.5))->T_from_to, truth), 0.25 * alone);
}

TEST(SensedMotion, LeavesOutStuckSensorsByName) {
  const auto stuck = [](double t) { return T_odom_base(std::min(t, 2.0)); };
  const auto stuck_rate = [](double t) { return rate_of(std::min(t, 2.0)); };
  MotionSensors sensors({});
  sensors.add({wheels_until(8.0, stuck), rates_until(8.0, stuck_rate)}, calibration(), true);
  compare_until(sensors, 0.0, 2.0);
  EXPECT_EQ(warnings_of(sensors), "");
  compare_until(sensors, 2.0, 7.0);
  const std::string warnings = warnings_of(sensors);
  EXPECT_TRUE(has(warnings, "wheels: left out from")) << warnings;
  EXPECT_TRUE(has(warnings, "gyroscope: left out from")) << warnings;
  EXPECT_FALSE(sensors.between(at(6.0), at(7.0)));
}

TEST(SensedMotion, UsesWheelsAgainAfterSlip) {
  const auto slipping = [](double t) {
    Eigen::Isometry3d pose = T_odom_base(t);
    pose.translation().x() += 0.3 * std::clamp(t - 2.0, 0.0, 2.0);
    return pose;
  };
  MotionSensors sensors({});
  sensors.add({wheels_until(20.0, slipping), {}}, calibration(), true);
  compare_until(sensors, 0.0, 4.5);
  EXPECT_TRUE(has(warnings_of(sensors), "wheels: left out from"));
  compare_until(sensors, 4.5, 15.0);
  EXPECT_TRUE(has(warnings_of(sensors), "wheels: used again"));
  EXPECT_TRUE(sensors.between(at(14.0), at(15.0)));
}

TEST(SensedMotion, SuspectsWrongMounting) {
  MotionCalibration wrong = calibration();
  wrong.T_sensor_base = Transform<Sensor, Base>(T_sensor_base() * motion(0, 0, 0, 0, 0, 0.09));
  wrong.T_sensor_imu = Transform<Sensor, Imu>(T_sensor_imu() * motion(0, 0, 0, 0.3, 0, 0));
  MotionSensors sensors({});
  sensors.add({wheels_until(9.0, T_odom_base), rates_until(9.0)}, wrong, true);
  compare_until(sensors, 0.0, 8.0);
  const std::string warnings = warnings_of(sensors);
  EXPECT_TRUE(has(warnings, "turned by about 5 degrees against the calibration")) << warnings;
  EXPECT_TRUE(has(warnings, "is T_sensor_base right?")) << warnings;
  EXPECT_TRUE(has(warnings, "gyroscope: left out")) << warnings;
}

TEST(SensedMotion, RecognizesDegreesPerSecond) {
  MotionSensors sensors({});
  sensors.add(
      {{}, rates_until(9.0, [](double t) -> Eigen::Vector3d { return rate_of(t) / kDegree; })},
      calibration(), true);
  compare_until(sensors, 0.0, 8.0);
  const std::string warnings = warnings_of(sensors);
  EXPECT_TRUE(has(warnings, "degrees per second")) << warnings;
}

TEST(SensedMotion, CorrectsDelayOfGyroscope) {
  std::vector<ImuSample> late = rates_until(12.0);
  for (ImuSample& sample : late) sample.stamp = sample.stamp + std::chrono::milliseconds(20);
  MotionSensors sensors({});
  sensors.add({{}, late}, calibration(), true);
  const auto error = [&] {
    return se3::angle(sensors.between(at(10.0), at(10.5))->T_from_to.inverse() *
                      true_motion(10.0, 10.5));
  };
  const double before = error();
  compare_until(sensors, 0.0, 10.0);
  const std::string warnings = warnings_of(sensors);
  EXPECT_TRUE(has(warnings, "ms too late and were corrected (imu_delay")) << warnings;
  EXPECT_LT(error(), 0.2 * before);  // within 4 of the 20 ms
}

TEST(SensedMotion, KnownDelayIsRemoved) {
  std::vector<WheelSample> late = wheels_until(3.0, T_odom_base);
  for (WheelSample& sample : late) sample.stamp = sample.stamp + std::chrono::milliseconds(50);
  MotionCalibration known = calibration();
  known.wheel_delay = std::chrono::milliseconds(50);
  MotionSensors sensors({});
  sensors.add({late, {}}, known, true);
  EXPECT_LT(position_error(sensors.between(at(1.0), at(2.0))->T_from_to, true_motion(1.0, 2.0)),
            1e-3);
}

TEST(SensedMotion, AssumesSensorThatLooksAheadWithWarning) {
  MotionSensors sensors({});
  const auto forward = [](double t) { return motion(t, 0, 0, 0, 0, 0); };
  sensors.add({wheels_until(2.0, forward), {}}, {}, true);
  EXPECT_TRUE(has(warnings_of(sensors), "T_sensor_base"));
  const auto sensed = sensors.between(at(0.5), at(1.5));
  EXPECT_TRUE(sensed->T_from_to.translation().isApprox(Eigen::Vector3d(0, 0, 1), 1e-9));
}

TEST(SensedMotion, SwitchedOffSensorsAreNotUsed) {
  MotionSensorsConfig config;
  config.wheels = config.imu = false;
  MotionSensors sensors(config);
  sensors.add({wheels_until(1.0, T_odom_base), rates_until(1.0)}, calibration(), true);
  EXPECT_TRUE(sensors.empty());
}

TEST(SensedMotion, ModelPredictsAcceleratedMotionByWheels) {
  MotionModel model{MotionConfig{}};
  model.sense({wheels_until(3.0, T_odom_base), {}}, calibration(), true);
  model.place(at(1.0), T_world_sensor(1.0));
  const PosePrediction first = model.predict(at(1.3));
  EXPECT_TRUE(first.is_sensed);
  EXPECT_TRUE(first.is_informative());
  EXPECT_LT(position_error(first.T_world_sensor, T_world_sensor(1.3)), 1e-3);
  model.coast(at(2.0));  // lost for a second
  EXPECT_LT(position_error(model.pose(), T_world_sensor(2.0)), 1e-3);
  EXPECT_LT(position_error(model.predict(at(2.9)).T_world_sensor, T_world_sensor(2.9)), 1e-3);
  const Eigen::Isometry3d pulled = T_world_sensor(2.9) * motion(0.3, 0, 0, 0, 0, 0);
  EXPECT_TRUE(model.contradiction(at(2.9), pulled));
  EXPECT_FALSE(model.contradiction(at(2.9), T_world_sensor(2.9)));
}

TEST(SensedMotion, ModelMovesOnAfterAGapInTheWheels) {
  for (const bool has_gyroscope : {false, true}) {
    std::vector<WheelSample> wheels = wheels_until(5.0, T_odom_base);
    std::erase_if(wheels, [](const WheelSample& sample) {
      return sample.stamp > at(1.5) && sample.stamp < at(1.8);
    });
    MotionModel model{MotionConfig{}};
    model.sense({wheels, has_gyroscope ? rates_until(5.0) : std::vector<ImuSample>{}},
                calibration(), true);
    model.place(at(0.95), T_world_sensor(0.95));
    model.measure(at(1.0), T_world_sensor(1.0));
    for (int i = 1; i <= 60; ++i) model.coast(at(1.0 + 0.05 * i));
    // In the gap the base drives on at 1 m/s, and turns by 16 degrees.
    const double allowed = has_gyroscope ? 0.5 : 1.3;
    EXPECT_LT(position_error(model.pose(), T_world_sensor(4.0)), allowed) << has_gyroscope;
  }
}

TEST(SensedMotion, ModelForgetsPosesInAnotherFrame) {
  MotionModel model{MotionConfig{}};
  model.sense({wheels_until(3.0, T_odom_base), {}}, calibration(), true);
  model.place(at(1.0), T_world_sensor(1.0));
  model.measure(at(1.1), T_world_sensor(1.1));
  const Eigen::Isometry3d moved = motion(0.1, 0, 0, 0, 0, 0);
  model.move(at(1.0), moved * T_world_sensor(1.0));
  model.measure(at(1.1), moved * T_world_sensor(1.1));
  EXPECT_FALSE(model.contradiction(at(1.2), moved * T_world_sensor(1.2)));
}

TEST(SensedMotion, ModelTurnsByGyroscopeAndMovesOn) {
  MotionModel model{MotionConfig{}};
  model.sense({{}, rates_until(3.0)}, calibration(), true);
  model.place(at(1.0), T_world_sensor(1.0));
  model.measure(at(1.05), T_world_sensor(1.05));
  const PosePrediction prediction = model.predict(at(1.2));
  EXPECT_LT(se3::angle(prediction.T_world_sensor.inverse() * T_world_sensor(1.2)), 2e-3);
  EXPECT_TRUE(prediction.T_world_sensor.translation().isApprox(
      model.extrapolate(at(1.2)).T_world_sensor.translation()));
  EXPECT_LT(prediction.rotation_sigma, model.extrapolate(at(1.2)).rotation_sigma);
}

}  // namespace
}  // namespace mms
