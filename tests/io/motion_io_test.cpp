#include "mms/io/motion/motion_io.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::TempFolder;

class MotionIo : public ::testing::Test {
 protected:
  template <class Read>
  std::string error_of(const std::string& text, const Read& read) {
    folder_.write("file.csv", text);
    try {
      read(folder_.path() / "file.csv");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
};

TEST_F(MotionIo, ReadsTumPosesAndPlanarPoses) {
  folder_.write("tum.txt", "# stamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 1 0\n");
  folder_.write("plane.csv", "# stamp,x,y,yaw\n1500000000000000000,1,2,1.5707963267948966\n");
  const auto tum = read_wheels(folder_.path() / "tum.txt");
  const auto plane = read_wheels(folder_.path() / "plane.csv");
  ASSERT_EQ(tum.size(), 1U);
  ASSERT_EQ(plane.size(), 1U);
  EXPECT_EQ(tum[0].stamp.nanoseconds(), 1'500'000'000);
  EXPECT_EQ(plane[0].stamp.nanoseconds(), 1'500'000'000'000'000'000);
  EXPECT_TRUE(tum[0].T_odom_base.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE((tum[0].T_odom_base.rotation() * Eigen::Vector3d::UnitX())
                  .isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((plane[0].T_odom_base.rotation() * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitY(), 1e-9));
}

TEST_F(MotionIo, ReadsEurocImu) {
  folder_.write("data.csv",
                "#timestamp [ns],w_RS_S_x [rad s^-1],...\n"
                "1403636579758555392,-0.1,0.15,0.08,8.1,-0.4,-2.4\n");
  const auto imu = read_imu(folder_.path() / "data.csv");
  ASSERT_EQ(imu.size(), 1U);
  EXPECT_EQ(imu[0].stamp.nanoseconds(), 1'403'636'579'758'555'392);
  EXPECT_TRUE(imu[0].rate.isApprox(Eigen::Vector3d(-0.1, 0.15, 0.08)));
  EXPECT_TRUE(imu[0].acceleration.isApprox(Eigen::Vector3d(8.1, -0.4, -2.4)));
}

TEST_F(MotionIo, ReadsStampsSinceTheStartOfTheSensor) {
  folder_.write("imu.csv", "5000000000000,0,0,0.1\n5000005000000,0,0,0.1\n5000010000000,0,0,0.1\n");
  const auto imu = read_imu(folder_.path() / "imu.csv");
  ASSERT_EQ(imu.size(), 3U);
  EXPECT_EQ(imu[0].stamp.nanoseconds(), 5'000'000'000'000);
  EXPECT_EQ(imu[2].stamp.nanoseconds(), 5'000'010'000'000);
}

TEST_F(MotionIo, WritesWithoutLoss) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.1, 1.0 / 3.0, 0.0);
  const std::vector<WheelSample> wheels = {
      {Timestamp(123'456'789), Transform<Odometer, Base>(pose)}};
  const std::vector<ImuSample> imu = {
      {Timestamp(987'654'321), Eigen::Vector3d(0.1, 0.2, 1.0 / 3.0), Eigen::Vector3d(1, 2, 9.81)}};
  write_wheels(folder_.path() / "odometry.csv", wheels);
  write_imu(folder_.path() / "imu.csv", imu);
  const auto wheels_read = read_wheels(folder_.path() / "odometry.csv");
  const auto imu_read = read_imu(folder_.path() / "imu.csv");
  EXPECT_EQ(wheels_read[0].stamp, wheels[0].stamp);
  EXPECT_EQ(wheels_read[0].T_odom_base.translation(), wheels[0].T_odom_base.translation());
  EXPECT_EQ(imu_read[0].stamp, imu[0].stamp);
  EXPECT_EQ(imu_read[0].rate, imu[0].rate);
  EXPECT_EQ(imu_read[0].acceleration, imu[0].acceleration);
}

TEST_F(MotionIo, ErrorsNameLineAndHint) {
  const auto wheels = [](const std::filesystem::path& path) { read_wheels(path); };
  const auto imu = [](const std::filesystem::path& path) { read_imu(path); };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  std::string error = error_of("1 0 0 0\n2 0 0\n", wheels);
  EXPECT_TRUE(has(error, "file.csv:2: 3 columns, expected stamp x y z")) << error;
  error = error_of("1,0,0,0\n2,nan,0,0\n", wheels);
  EXPECT_TRUE(has(error, "file.csv:2")) << error;
  error = error_of("2,0,0,0\n\n1,0,0,0\n", imu);
  EXPECT_TRUE(has(error, "file.csv:3: stamp 1.000000000 is before")) << error;
  EXPECT_TRUE(has(error, "sort the lines")) << error;
  error = error_of("timestamp,wx,wy,wz\n1,0,0,0\n", imu);
  EXPECT_TRUE(has(error, "file.csv:1: 'timestamp' is not a stamp")) << error;
  error = error_of("1 0 0 0 0 0 0 0\n", wheels);
  EXPECT_TRUE(has(error, "the quaternion is zero")) << error;
  error = error_of("# nothing\n", imu);
  EXPECT_TRUE(has(error, "has no measurements")) << error;
}

TEST_F(MotionIo, RepeatedStampsAreLeftOut) {
  folder_.write("odometry.csv", "1,0,0,0\n1,0,0,0\n2,1,0,0\n");
  EXPECT_EQ(read_wheels(folder_.path() / "odometry.csv").size(), 2U);
}

TEST(MotionFaultText, FindsGapsAndDegrees) {
  MotionSamples samples;
  for (const double t : {0.0, 0.1, 0.2, 1.4, 1.5}) {
    samples.wheels.push_back({Timestamp::from_seconds(t), {}});
    samples.imu.push_back(
        {Timestamp::from_seconds(t), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d::Zero()});
  }
  const auto faults = faults_of(samples, "x");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0], "x: wheels have 1 gaps of more than 0.5 s, the longest 1.2 s");
  for (ImuSample& sample : samples.imu) sample.rate *= 57.3;
  EXPECT_NE(faults_of(samples, "x").back().find("degrees per second"), std::string::npos);
}

}  // namespace
}  // namespace mms
