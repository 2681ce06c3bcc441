#include "mms/mapping/ground/floor_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/mapping/synthetic_room.hpp"

namespace mms::test {
namespace {

const Eigen::Vector3d kCameraUp(0, -1, 0);

/// Tracks the floor in views of a room; the world is the first camera's frame.
class FloorRun {
 public:
  explicit FloorRun(const Transform<RoomFrame, Sensor>& first, double rate = 15.0)
      : first_(first), rate_(rate) {}

  /// Adds the views of some seconds from one place.
  void add(const Room& room, const Transform<RoomFrame, Sensor>& now, double seconds) {
    const Transform<World, Sensor> T_world_sensor(first_.isometry().inverse() * now.isometry());
    LabeledCloud cloud = view(room, now);
    for (int i = 0; i < std::lround(seconds * rate_); ++i) {
      cloud.stamp = Timestamp::from_seconds(1.0 + frames_++ / rate_);
      tracker_.update(cloud, T_world_sensor, kCameraUp);
    }
  }

  const std::optional<Floor>& floor() const { return tracker_.floor(); }

 private:
  Transform<RoomFrame, Sensor> first_;
  double rate_;
  int frames_ = 0;
  FloorTracker tracker_;
};

TEST(FloorTracker, FindsFloorBelowPitchedCamera) {
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.3);
  FloorRun run(camera);
  run.add(Room(), camera, 1.4);
  ASSERT_TRUE(run.floor().has_value());
  const Eigen::Vector3d up = camera.rotation().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_GT(run.floor()->up.dot(up), std::cos(0.01));
  EXPECT_NEAR(run.floor()->height, -1.4, 0.02);
}

TEST(FloorTracker, TableDoesNotReplaceFloor) {
  Room room;
  const auto first = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.3);
  FloorRun run(first);
  run.add(room, first, 0.7);
  room.boxes.push_back({{-1.5, -1.9, 0.0}, {2.9, 1.9, 0.8}});
  run.add(room, camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.6), 0.7);
  ASSERT_TRUE(run.floor().has_value());
  EXPECT_NEAR(run.floor()->height, -1.4, 0.03);
}

TEST(FloorTracker, LowerFloorReplacesFormerImmediately) {
  Room room;
  room.boxes.push_back({{-2.9, -1.9, 0.0}, {2.9, 1.9, 0.5}});
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.4);
  FloorRun run(camera);
  run.add(room, camera, 0.7);
  EXPECT_NEAR(run.floor().value().height, -0.9, 0.03);
  run.add(Room(), camera, 0.4);
  EXPECT_NEAR(run.floor().value().height, -1.4, 0.03);
}

TEST(FloorTracker, PersistentHigherFloorReplacesFormerAfterThreeSecondsAtAnyRate) {
  Room raised;
  raised.boxes.push_back({{-2.9, -1.9, 0.0}, {2.9, 1.9, 0.5}});
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.4);
  for (const double rate : {5.0, 15.0, 60.0}) {
    FloorRun run(camera, rate);
    run.add(Room(), camera, 1.0);
    run.add(raised, camera, 2.6);
    EXPECT_NEAR(run.floor().value().height, -1.4, 0.03) << rate;
    run.add(raised, camera, 1.0);
    EXPECT_NEAR(run.floor().value().height, -0.9, 0.03) << rate;
  }
}

TEST(FloorTracker, HasNoFloorWithoutOneInView) {
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, -0.6);
  FloorRun run(camera);
  run.add(Room(), camera, 0.7);
  EXPECT_FALSE(run.floor().has_value());
}

}  // namespace
}  // namespace mms::test
