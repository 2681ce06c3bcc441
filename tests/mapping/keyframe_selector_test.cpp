#include "mms/mapping/static_map/keyframe_selector.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mms {
namespace {

OdometryEstimate estimate(double seconds, double x, double degrees,
                          Status status = Status::kTracking) {
  OdometryEstimate odometry;
  odometry.stamp = Timestamp::from_seconds(seconds);
  odometry.status = status;
  odometry.T_world_sensor = Transform<World, Sensor>(
      Eigen::Translation3d(x, 0.0, 0.0) *
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()) *
      Eigen::Isometry3d::Identity());
  return odometry;
}

TEST(KeyframeSelector, SelectsFirstFrame) {
  KeyframeSelector selector;
  EXPECT_TRUE(selector.is_keyframe(estimate(0.0, 0.0, 0.0, Status::kInitialized)));
}

TEST(KeyframeSelector, MeasuresMotionFromLastKeyframe) {
  KeyframeSelector selector({.translation = 0.10, .rotation = 5.0, .max_interval = 100.0});
  ASSERT_TRUE(selector.is_keyframe(estimate(0.0, 0.0, 0.0)));
  EXPECT_FALSE(selector.is_keyframe(estimate(0.1, 0.06, 0.0)));
  EXPECT_TRUE(selector.is_keyframe(estimate(0.2, 0.12, 0.0)));
  EXPECT_FALSE(selector.is_keyframe(estimate(0.3, 0.20, 4.0)));
  EXPECT_TRUE(selector.is_keyframe(estimate(0.4, 0.20, 6.0)));
}

TEST(KeyframeSelector, SelectsStaticCameraAfterInterval) {
  KeyframeSelector selector({.translation = 0.10, .rotation = 5.0, .max_interval = 1.0});
  ASSERT_TRUE(selector.is_keyframe(estimate(0.0, 0.0, 0.0)));
  EXPECT_FALSE(selector.is_keyframe(estimate(0.9, 0.0, 0.0)));
  EXPECT_TRUE(selector.is_keyframe(estimate(1.0, 0.0, 0.0)));
  EXPECT_FALSE(selector.is_keyframe(estimate(1.9, 0.0, 0.0)));
}

TEST(KeyframeSelector, NeverSelectsLostFrame) {
  KeyframeSelector selector;
  EXPECT_FALSE(selector.is_keyframe(estimate(0.0, 0.0, 0.0, Status::kLost)));
  ASSERT_TRUE(selector.is_keyframe(estimate(0.1, 0.0, 0.0)));
  EXPECT_FALSE(selector.is_keyframe(estimate(9.0, 5.0, 90.0, Status::kLost)));
  EXPECT_TRUE(selector.is_keyframe(estimate(9.1, 5.0, 90.0, Status::kRecovered)));
}

}  // namespace
}  // namespace mms
