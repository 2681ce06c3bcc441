#include "mms/mapping/ground/floor_tracker.hpp"

#include <gtest/gtest.h>

#include "tests/mapping/synthetic_room.hpp"

namespace mms::test {
namespace {

const Eigen::Vector3d kCameraUp(0, -1, 0);

/// Gives the watch `frames` views of the room; the world is the first camera's frame.
void track(FloorTracker& tracker, const Room& room, const Transform<RoomFrame, Sensor>& first,
           const Transform<RoomFrame, Sensor>& now, int frames) {
  const Transform<World, Sensor> T_world_sensor(first.isometry().inverse() * now.isometry());
  for (int i = 0; i < frames; ++i) tracker.update(view(room, now), T_world_sensor, kCameraUp);
}

TEST(FloorTracker, FindsFloorBelowPitchedCamera) {
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.3);
  FloorTracker floor;
  track(floor, Room(), camera, camera, 20);
  ASSERT_TRUE(floor.floor().has_value());
  const Eigen::Vector3d up = camera.rotation().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_GT(floor.floor()->up.dot(up), std::cos(0.01));
  EXPECT_NEAR(floor.floor()->height, -1.4, 0.02);
}

TEST(FloorTracker, TableDoesNotReplaceFloor) {
  Room room;
  const auto first = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.3);
  FloorTracker floor;
  track(floor, room, first, first, 10);
  room.boxes.push_back({{-1.5, -1.9, 0.0}, {2.9, 1.9, 0.8}});
  track(floor, room, first, camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.6), 10);
  ASSERT_TRUE(floor.floor().has_value());
  EXPECT_NEAR(floor.floor()->height, -1.4, 0.03);
}

TEST(FloorTracker, LowerFloorReplacesFormerImmediately) {
  Room room;
  room.boxes.push_back({{-2.9, -1.9, 0.0}, {2.9, 1.9, 0.5}});
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, 0.4);
  FloorTracker floor;
  track(floor, room, camera, camera, 10);
  EXPECT_NEAR(floor.floor().value().height, -0.9, 0.03);
  track(floor, Room(), camera, camera, 5);
  EXPECT_NEAR(floor.floor().value().height, -1.4, 0.03);
}

TEST(FloorTracker, HasNoFloorWithoutOneInView) {
  const auto camera = camera_in_room({-2.0, 0.0, 1.4}, 0.0, -0.6);
  FloorTracker floor;
  track(floor, Room(), camera, camera, 10);
  EXPECT_FALSE(floor.floor().has_value());
}

}  // namespace
}  // namespace mms::test
