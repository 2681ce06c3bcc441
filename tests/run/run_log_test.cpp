#include "mms/run/record/run_log.hpp"

#include <gtest/gtest.h>

#include "tests/pipeline/played_scene.hpp"

namespace mms {
namespace {

constexpr int kFrames = 5;

Timestamp stamp_of(int i) {
  return Timestamp::from_seconds(0.1 * i);
}

Transform<World, Sensor> pose_of(int i) {
  return Transform<World, Sensor>(Eigen::Isometry3d(Eigen::Translation3d(0.1 * i, 0.0, 0.0)));
}

/// Metrics of a run with truth whose first frames are of its first session, and the others of one
/// whose place in the map is not known.
RunMetrics metrics_of(int frames_in_map) {
  SlamSystem system = testing::mask_system();
  const Frame& frame = testing::scene_frame(0);
  Processed processed{frame, system.process(frame), 0.0, std::nullopt};
  EXPECT_EQ(system.global_map().records().size(), 1U);
  Trajectory truth;
  for (int i = 0; i < kFrames; ++i) truth.push_back({stamp_of(i), pose_of(i)});
  RunLog log(truth, false, {});
  for (int i = 0; i < kFrames; ++i) {
    processed.frame.stamp = stamp_of(i);
    processed.result.session = i < frames_in_map ? 0U : 1U;
    processed.result.odometry.T_world_sensor = pose_of(i);
    log.add(processed);
  }
  log.finish(0, 0, AsyncPipeline(AsyncOptions()), system);
  EXPECT_EQ(log.corrected_trajectory().size(), static_cast<std::size_t>(frames_in_map));
  return log.metrics();
}

TEST(RunLog, ErrorInTheMapNeedsThreePoses) {
  const RunMetrics few = metrics_of(2);
  ASSERT_TRUE(few.trajectory && few.loops);
  EXPECT_EQ(few.trajectory->matched, 5U);
  EXPECT_FALSE(few.loops->trajectory);
  const RunMetrics enough = metrics_of(3);
  ASSERT_TRUE(enough.loops && enough.loops->trajectory);
  EXPECT_EQ(enough.loops->trajectory->matched, 3U);
}

TEST(RunLog, LostFramesDoNotMoveTheTrueMap) {
  SlamSystem system = testing::mask_system();
  const Frame& frame = testing::scene_frame(0);
  Processed processed{frame, system.process(frame), 0.0, std::nullopt};
  Trajectory truth;
  for (int i = 0; i < kFrames; ++i) truth.push_back({stamp_of(i), pose_of(i)});
  RunLog log(truth, false, {});
  for (int i = 0; i < kFrames; ++i) {
    const bool lost = i == 2;
    processed.frame.stamp = stamp_of(i);
    processed.result.odometry.status = lost ? Status::kLost : Status::kTracking;
    processed.result.odometry.T_world_sensor = pose_of(lost ? i + 10 : i);  // 1 m too far
    log.add(processed);
  }
  log.finish(0, 0, AsyncPipeline(AsyncOptions()), system);
  TruthCloud cloud;
  cloud.points = {{0.0F, 0.0F, 2.0F}, {0.0F, 1.0F, 2.0F}};
  cloud.labels = {0, 0};
  log.compare_map(cloud, cloud.points);
  ASSERT_TRUE(log.metrics().map);
  EXPECT_EQ(log.metrics().map->SA, 100.0);
}

}  // namespace
}  // namespace mms
