#include "mms/dataset/source/motion_files.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/dataset/simulated/scene_source.hpp"
#include "mms/dataset/simulated/simulation_writer.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

const std::string kWheels = "5.00,0,0,0\n5.09,1,0,0\n5.11,2,0,0\n5.13,3,0,0\n5.20,4,0,0\n";
const std::string kRates = "# a header\n5.05,0,0,1\n5.15,0,0,2\n5.25,0,0,3\n";

TEST(MotionFiles, FramesBringMeasurementsSinceTheOneBefore) {
  TempFolder folder;
  write_tum(folder, 3);  // 5.0, 5.1 and 5.2 s
  folder.write("odometry.csv", kWheels);
  folder.write("imu.csv", kRates);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 3U);
  EXPECT_EQ(played.frames[0].motion.wheels.size(), 1U);
  EXPECT_EQ(played.frames[1].motion.wheels.size(), 2U);  // up to 20 ms after the frame
  EXPECT_EQ(played.frames[2].motion.wheels.size(), 2U);
  EXPECT_EQ(played.frames[1].motion.wheels[1].T_odom_base.translation().x(), 2.0);
  EXPECT_EQ(played.frames[2].motion.imu.size(), 1U);
  EXPECT_EQ(played.frames[2].motion.imu[0].rate.z(), 2.0);
  EXPECT_TRUE(any_has(played.source->describe(), "wheels: 5 measurements of "));
  EXPECT_TRUE(any_has(played.source->describe(), "gyroscope: 3 measurements of "));
}

TEST(MotionFiles, OptionsReplaceOrOmitThem) {
  TempFolder folder;
  write_tum(folder, 3);
  folder.write("odometry.csv", kWheels);
  folder.write("other.txt", "5.0 0 0 0 0 0 0 1\n5.1 7 0 0 0 0 0 1\n");
  const Playback other(
      open_dataset(folder.path(), {.motion = {.wheels = folder.path() / "other.txt"}}));
  EXPECT_EQ(other.frames[1].motion.wheels[0].T_odom_base.translation().x(), 7.0);
  const Playback without(open_dataset(folder.path(), {.motion = {.wheels = "none"}}));
  EXPECT_TRUE(without.frames[1].motion.empty());
  EXPECT_FALSE(any_has(without.source->describe(), "wheels:"));
}

TEST(MotionFiles, AccelerometerAloneIsNoGyroscope) {
  TempFolder folder;
  write_tum(folder, 3);
  folder.write("imu.csv", "5.0,0,0,0,0,0,9.8\n5.1,0,0,0,0,0,9.7\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(played.frames[0].motion.empty());
  EXPECT_TRUE(any_has(played.warnings, "always gives the same rate"));
}

TEST(MotionFiles, DamagedFilesAreLeftOutOrErrors) {
  TempFolder folder;
  write_tum(folder, 3);
  folder.write("odometry.csv", "5.0,0,0\n");
  folder.write("imu.csv", "time,accel_x,accel_y,accel_z\n5.0,0,0,9.8\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(played.frames.at(0).motion.empty());
  EXPECT_TRUE(any_has(played.warnings, "odometry.csv:1: 3 columns, expected stamp x y z"));
  EXPECT_TRUE(any_has(played.warnings, "imu.csv:1: 'time' is not a stamp"));
  EXPECT_THROW(open_dataset(folder.path(), {.motion = {.wheels = folder.path() / "odometry.csv"}}),
               DataError);
  EXPECT_THROW(open_dataset("sim:static", {.motion = {.wheels = folder.path() / "odometry.csv"}}),
               DataError);
}

TEST(MotionFiles, CalibrationHasTheirMounting) {
  TempFolder folder;
  write_tum(folder, 1);
  folder.write("calibration.yaml", kCalibration +
                                       "T_sensor_base: [0, -1, 0, 0.1, 0, 0, -1, 1, 1, 0, 0, 0]\n" +
                                       "wheel_delay: 0.02\n");
  const Playback played(open_dataset(folder.path()));
  const MotionCalibration& motion = played.frames.at(0).calibration->motion;
  ASSERT_TRUE(motion.T_sensor_base);
  EXPECT_FALSE(motion.T_sensor_imu);
  EXPECT_TRUE(motion.T_sensor_base->translation().isApprox(Eigen::Vector3d(0.1, 1, 0)));
  EXPECT_EQ(motion.wheel_delay, std::chrono::milliseconds(20));
}

/// A simulation, its recording, and a copy of that by `mms convert` bring the same measurements.
TEST(MotionFiles, RecordingsOfScenesKeepThem) {
  SceneConfig config = scene_config("static");
  config.width = 64;
  config.frames = 4;
  config.wheels.enabled = config.imu.enabled = true;
  TempFolder folder;
  SimulatedScene scene(config);
  write_simulation(scene, folder.path() / "scene");
  const Playback played(open_dataset(folder.path() / "scene"));
  const Playback simulated(play_scene(config, true));
  const auto recorder = record_folder(folder.path() / "copy");
  for (const Frame& frame : played.frames) recorder->add(frame);
  recorder->finish({});
  const Playback copied(open_dataset(folder.path() / "copy"));
  for (const Playback* other : {&simulated, &copied}) {
    ASSERT_EQ(other->frames.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      const MotionSamples& a = played.frames[i].motion;
      const MotionSamples& b = other->frames[i].motion;
      ASSERT_EQ(a.wheels.size(), b.wheels.size()) << i;
      ASSERT_EQ(a.imu.size(), b.imu.size()) << i;
      EXPECT_GT(a.imu.size(), 3U);
      EXPECT_EQ(a.wheels.back().T_odom_base.translation(),
                b.wheels.back().T_odom_base.translation());
      EXPECT_EQ(a.imu.back().rate, b.imu.back().rate);
      EXPECT_TRUE(other->frames[i].calibration->motion.T_sensor_base->isometry().isApprox(
          scene.calibration().motion.T_sensor_base->isometry(), 1e-9));
    }
  }
}

}  // namespace
}  // namespace mms
