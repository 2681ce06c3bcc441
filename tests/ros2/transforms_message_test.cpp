#include <gtest/gtest.h>

#include "mms/result_messages/result_messages.hpp"

namespace mms {
namespace {

TEST(TransformsMessage, HasThePoseOfTheRobot) {
  Eigen::Isometry3d T_world_sensor(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  T_world_sensor.translation() = Eigen::Vector3d(1.0, 2.0, 0.0);
  FrameResult result;
  result.odometry.T_world_sensor = Transform<World, Sensor>(T_world_sensor);
  FrameNames frames{"map", "mms_world", {"base_link", Eigen::Isometry3d::Identity()}};
  frames.robot.T_sensor_frame.translation() = Eigen::Vector3d(-0.4, 0.0, 0.0);
  const msg::Transforms message = transforms_message({}, frames, result, false);
  ASSERT_FALSE(message.transforms.empty());
  const msg::TransformStamped& robot = message.transforms.front();
  EXPECT_EQ(robot.header.frame_id, "mms_world");
  EXPECT_EQ(robot.child_frame_id, "base_link");
  EXPECT_NEAR(robot.transform.position[0], 1.0, 1e-12);
  EXPECT_NEAR(robot.transform.position[1], 1.6, 1e-12);
}

}  // namespace
}  // namespace mms
