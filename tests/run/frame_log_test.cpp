#include "mms/run/record/frame_log.hpp"

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

TEST(FrameLog, GivesTheFramesAsTheyWere) {
  constexpr int kFrames = 9;
  const TempFolder folder;
  FrameLog log(folder.path());
  for (int i = 0; i < kFrames; ++i) log.add(some_frame(i));
  EXPECT_EQ(log.first().stamp, some_frame(0).stamp);
  EXPECT_EQ(log.last().stamp, some_frame(kFrames - 1).stamp);
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

TEST(ObjectLog, GivesTheObjectsAsTheyWere) {
  const TempFolder folder;
  ObjectLog log(folder.path());
  for (int i = 0; i < 5; ++i) {
    ObjectFrame frame{Timestamp(i), {}};
    for (int id = 0; id < i; ++id) {
      ObjectBox& box = frame.objects.emplace_back();
      box.id = id;
      box.object_class = ObjectClass::kAgv;
      box.T_world_box = some_pose(id);
      box.size = Eigen::Vector3d(1.0, 2.0, id);
      box.velocity = Eigen::Vector3d(-1.0, 0.5, i);
      box.moving = id % 2 == 0;
      box.score = 0.25;
    }
    log.add(frame);
  }
  const ObjectHistory history = log.read();
  ASSERT_EQ(history.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const ObjectFrame& frame = history[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.stamp, Timestamp(i));
    ASSERT_EQ(frame.objects.size(), static_cast<std::size_t>(i));
    for (int id = 0; id < i; ++id) {
      const ObjectBox& box = frame.objects[static_cast<std::size_t>(id)];
      EXPECT_EQ(box.id, id);
      EXPECT_EQ(box.object_class, ObjectClass::kAgv);
      EXPECT_EQ(box.T_world_box.matrix(), some_pose(id).matrix());
      EXPECT_EQ(box.size, Eigen::Vector3d(1.0, 2.0, id));
      EXPECT_EQ(box.velocity, Eigen::Vector3d(-1.0, 0.5, i));
      EXPECT_EQ(box.moving, id % 2 == 0);
      EXPECT_EQ(box.score, 0.25);
      EXPECT_EQ(box.visible, 1.0);
    }
  }
}

}  // namespace
}  // namespace mms
