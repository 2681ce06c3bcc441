#include "mms/ros/robot_frame.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

msg::TransformStamped transform(const char* parent, const char* child, std::int64_t stamp,
                                double x) {
  msg::TransformStamped message;
  message.header = {0, Timestamp(stamp), parent};
  message.child_frame_id = child;
  message.transform.position = {x, 0.0, 0.0};
  return message;
}

TEST(RobotFrame, IsTheSensorWithoutARobot) {
  const RobotFrame::Pose pose = RobotFrame("map", "mms_world").above("camera", Timestamp(1));
  EXPECT_EQ(pose.frame, "camera");
  EXPECT_TRUE(pose.T_sensor_frame.isApprox(Eigen::Isometry3d::Identity()));
}

TEST(RobotFrame, IsTheBaseOfTheRobot) {
  RobotFrame robot("map", "mms_world");
  robot.add({{transform("base_link", "mast", 0, 0.3), transform("/mast", "/camera", 0, 0.1)}});
  const RobotFrame::Pose pose = robot.above("camera", Timestamp(1));
  EXPECT_EQ(pose.frame, "base_link");
  EXPECT_NEAR(pose.T_sensor_frame.translation().x(), -0.4, 1e-12);
}

TEST(RobotFrame, IsTheFrameOfAnotherOdometry) {
  RobotFrame robot("map", "mms_world");
  robot.add({{transform("base_link", "camera", 0, 0.1), transform("odom", "base_link", 10, 1.0),
              transform("odom", "base_link", 20, 2.0)}});
  EXPECT_EQ(robot.above("camera", Timestamp(19)).frame, "odom");
  EXPECT_NEAR(robot.above("camera", Timestamp(19)).T_sensor_frame.translation().x(), -2.0, 1e-12);
}

TEST(RobotFrame, IgnoresWhatTheNodePublishes) {
  RobotFrame robot("map", "mms_world");
  robot.add({{transform("mms_world", "base_link", 5, 7.0), transform("map", "mms_world", 5, 1.0),
              transform("base_link", "camera", 0, 0.1)}});
  EXPECT_EQ(robot.above("camera", Timestamp(5)).frame, "base_link");
}

}  // namespace
}  // namespace mms
