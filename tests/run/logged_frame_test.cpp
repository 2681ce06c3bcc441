#include "mms/run/record/logged_frame.hpp"

#include <gtest/gtest.h>

#include "mms/geometry/se3.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::TempFolder;

Eigen::Isometry3d some_pose(int i) {
  Vector6d tangent;
  tangent << 0.1, -0.2, 0.3, 0.02, -0.01, 0.03;
  return se3::exp(i * tangent);
}

LoggedFrame some_frame(int i) {
  LoggedFrame frame;
  frame.stamp = Timestamp(1'000'000'000LL * i + 7);
  frame.index = 3 * i;
  frame.session = static_cast<std::uint32_t>(i / 4);
  frame.T_world_sensor = Transform<World, Sensor>(some_pose(i));
  frame.status = i % 3 == 0 ? Status::kLost : Status::kTracking;
  frame.keyframe = i % 2 == 0;
  frame.in_map = i % 5 == 0;
  frame.dynamic_share = 0.1 * i;
  frame.implausible_masks = i;
  frame.stage_ms = {1.0 + i, 2.0, 3.0};
  if (i % 2 == 1) frame.latency_ms = 5.5 + i;
  return frame;
}

TEST(LoggedFrame, IsReadFromDiskAsItWas) {
  constexpr int kFrames = 9;
  const TempFolder folder;
  DiskLog<LoggedFrame> log(folder.path());
  for (int i = 0; i < kFrames; ++i) log.add(some_frame(i));
  const std::vector<LoggedFrame> frames = log.read();
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  ASSERT_EQ(log.size(), frames.size());
  for (int i = 0; i < kFrames; ++i) {
    const LoggedFrame& frame = frames[static_cast<std::size_t>(i)];
    const LoggedFrame expected = some_frame(i);
    EXPECT_EQ(frame.stamp, expected.stamp);
    EXPECT_EQ(frame.index, expected.index);
    EXPECT_EQ(frame.session, expected.session);
    EXPECT_EQ(frame.T_world_sensor.isometry().matrix(),
              expected.T_world_sensor.isometry().matrix());
    EXPECT_EQ(frame.status, expected.status);
    EXPECT_EQ(frame.keyframe, expected.keyframe);
    EXPECT_EQ(frame.in_map, expected.in_map);
    EXPECT_FALSE(frame.relocalized || frame.is_searching);
    EXPECT_EQ(frame.dynamic_share, expected.dynamic_share);
    EXPECT_EQ(frame.implausible_masks, expected.implausible_masks);
    EXPECT_EQ(frame.stage_ms, expected.stage_ms);
    EXPECT_EQ(frame.latency_ms, expected.latency_ms);
  }
}

}  // namespace
}  // namespace mms
