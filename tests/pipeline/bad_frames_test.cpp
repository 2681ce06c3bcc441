// Frames without usable data: a status, never an exception or a crash.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

using testing::mask_system;
using testing::scene;
using testing::scene_frame;

/// A frame of the scene whose depth is everywhere `value`.
Frame blind(std::size_t index, float value) {
  Frame frame = scene_frame(index);
  frame.depth = Image<float>(frame.depth.width(), frame.depth.height(), value);
  return frame;
}

TEST(BadFrames, RecoversAfterFiftyFramesWithoutDepth) {
  SlamSystem system = mask_system();
  for (std::size_t i = 0; i < 5; ++i) system.process(scene_frame(i));
  const std::size_t map_size = system.static_map().size();
  const std::array<float, 3> no_return = {0.0F, std::numeric_limits<float>::quiet_NaN(),
                                          std::numeric_limits<float>::infinity()};
  const Duration period = scene_frame(1).stamp - scene_frame(0).stamp;
  for (int i = 1; i <= 50; ++i) {
    Frame frame = blind(4, no_return[static_cast<std::size_t>(i) % 3]);
    frame.stamp = scene_frame(4).stamp + i * period;
    const FrameResult result = system.process(frame);
    EXPECT_EQ(result.odometry.status, Status::kLost);
    EXPECT_TRUE(result.odometry.T_world_sensor.is_finite());
    EXPECT_FALSE(result.keyframe);
    EXPECT_EQ(result.dynamic_share, 0.0);
  }
  EXPECT_EQ(system.static_map().size(), map_size);
  for (std::size_t i = 5; i < 12; ++i) {
    Frame frame = scene_frame(i);
    frame.stamp = frame.stamp + 50 * period;
    const FrameResult result = system.process(frame);
    // Two frames recognize the place.
    EXPECT_EQ(result.odometry.status, i == 5   ? Status::kLost
                                      : i == 6 ? Status::kRecovered
                                               : Status::kTracking);
    const Eigen::Vector3d truth = scene().truth(static_cast<int>(i)).T_world_sensor.translation();
    EXPECT_LT((result.odometry.T_world_sensor.translation() - truth).norm(), 0.03);
  }
}

TEST(BadFrames, InitializesAtFirstFrameWithDepth) {
  SlamSystem system = mask_system();
  EXPECT_EQ(system.process(blind(0, 0.0F)).odometry.status, Status::kLost);
  EXPECT_EQ(system.process(blind(1, NAN)).odometry.status, Status::kLost);
  EXPECT_EQ(system.static_map().size(), 0U);
  const FrameResult first = system.process(scene_frame(2));
  EXPECT_EQ(first.odometry.status, Status::kInitialized);
  EXPECT_TRUE(first.odometry.T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_GT(system.static_map().size(), 0U);
}

TEST(BadFrames, ReportsEmptyFramesLost) {
  SlamSystem system = mask_system();
  Frame empty;
  empty.calibration = scene_frame(0).calibration;
  EXPECT_EQ(system.process(empty).odometry.status, Status::kLost);
  system.process(scene_frame(0));
  empty.stamp = scene_frame(1).stamp;
  const FrameResult result = system.process(empty);
  EXPECT_EQ(result.odometry.status, Status::kLost);
  EXPECT_TRUE(result.cloud.points.empty());
  EXPECT_EQ(system.process(scene_frame(2)).odometry.status, Status::kRecovered);
}

TEST(BadFrames, RejectsImagesOfDifferentSizes) {
  SlamSystem system = mask_system();
  Frame frame = scene_frame(0);
  frame.depth = Image<float>(100, 100, 2.0F);
  EXPECT_THROW(system.process(frame), DataError);
}

TEST(BadFrames, ReportsFullyMaskedFrameLost) {
  SlamSystem system = mask_system();
  system.process(scene_frame(0));
  Frame covered = scene_frame(1);
  for (std::uint8_t& pixel : covered.mask.pixels()) pixel = 1;
  for (float& z : covered.depth.pixels()) z = 1.0F;  // a person in front of the lens
  const FrameResult result = system.process(covered);
  EXPECT_EQ(result.odometry.status, Status::kLost);
  EXPECT_GT(result.dynamic_share, 0.9);
}

TEST(BadFrames, RefusesScansOfDifferentLengthsAndFramesWithoutCalibration) {
  SlamSystem system = mask_system();
  Frame frame;
  frame.scan.points.assign(2000, Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_THROW(system.process(frame), DataError);
  frame.calibration = std::make_shared<const Calibration>();
  frame.scan.time_offset.assign(3000, 0.0F);
  EXPECT_THROW(system.process(frame), DataError);
  frame.scan.time_offset.clear();
  frame.scan.intensity.assign(10, 1.0F);
  EXPECT_THROW(system.process(frame), DataError);
}

}  // namespace
}  // namespace mms
