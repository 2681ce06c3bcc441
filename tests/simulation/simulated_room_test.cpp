#include "mms/simulation/simulated_room.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

RoomConfig small_room() {
  RoomConfig config;
  config.width = 320;
  config.height = 240;
  return config;
}

Frame rendered_by(const SimulatedRoom& room, int index, int threads) {
  tbb::task_arena arena(threads);
  Frame frame;
  arena.execute([&] { frame = room.render(index); });
  return frame;
}

/// World point at a pixel.
Eigen::Vector3d point_at(const Frame& frame, const Transform<World, Sensor>& T, int x, int y) {
  const CameraModel camera(*frame.calibration->camera);
  return T * Eigen::Vector3d(static_cast<double>(frame.depth(x, y)) * camera.ray({x, y}));
}

TEST(SimulatedRoom, IsTheSameForAnyNumberOfThreads) {
  const SimulatedRoom room(small_room());
  const Frame one = rendered_by(room, 40, 1);
  const Frame two = rendered_by(SimulatedRoom(small_room()), 40, 2);
  EXPECT_EQ(one.color.pixels(), two.color.pixels());
  EXPECT_EQ(one.depth.pixels(), two.depth.pixels());
  EXPECT_EQ(one.mask.pixels(), two.mask.pixels());
  EXPECT_EQ(one.stamp, two.stamp);
}

TEST(SimulatedRoom, TheSeedChangesIt) {
  RoomConfig other = small_room();
  other.seed = 2;
  EXPECT_NE(SimulatedRoom(small_room()).render(0).color.pixels(),
            SimulatedRoom(other).render(0).color.pixels());
}

TEST(SimulatedRoom, TruthStartsAtTheOriginAndDrivesSmoothly) {
  const SimulatedRoom room;
  EXPECT_TRUE(room.truth(0).T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
  double length = 0.0;
  for (int i = 1; i < room.size(); ++i) {
    const double step = (room.truth(i).T_world_sensor.translation() -
                         room.truth(i - 1).T_world_sensor.translation())
                            .norm();
    EXPECT_LT(step, 0.4 / 15.0);
    length += step;
  }
  EXPECT_GT(length, 2.5);
}

TEST(SimulatedRoom, DepthOfOneFrameReprojectsOntoAnother) {
  RoomConfig config = small_room();
  config.moving_objects = false;
  config.noise = false;
  const SimulatedRoom room(config);
  const Frame a = room.render(10);
  const Frame b = room.render(30);
  const CameraModel camera(*b.calibration->camera);
  const auto T_b_world = room.truth(30).T_world_sensor.inverse();
  int seen = 0;
  int agree = 0;
  for (int y = 0; y < 240; y += 3) {
    for (int x = 0; x < 320; x += 3) {
      if (a.depth(x, y) <= 0.0F) continue;
      const Eigen::Vector3d p = T_b_world * point_at(a, room.truth(10).T_world_sensor, x, y);
      const Eigen::Vector2d pixel = camera.project(p);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (p.z() <= 0.0 || !b.depth.contains(u, v)) continue;
      ++seen;
      agree += std::abs(static_cast<double>(b.depth(u, v)) - p.z()) < 0.02 * p.z();
    }
  }
  EXPECT_GT(seen, 4000);
  EXPECT_GT(agree, seen * 95 / 100);  // the rest is hidden in one of them
}

TEST(SimulatedRoom, DepthNoiseFollowsTheModel) {
  RoomConfig config = small_room();
  config.moving_objects = false;
  const Frame noisy = SimulatedRoom(config).render(0);
  config.noise = false;
  const Frame exact = SimulatedRoom(config).render(0);
  double sum = 0.0;
  int count = 0;
  int holes = 0;
  for (std::size_t i = 0; i < noisy.depth.size(); ++i) {
    const double z = static_cast<double>(exact.depth[i]);
    holes += noisy.depth[i] == 0.0F;
    const double sigma = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
    const double off = (static_cast<double>(noisy.depth[i]) - z) / sigma;
    if (std::abs(off) > 4.0) continue;  // rims
    sum += off * off;
    ++count;
  }
  EXPECT_NEAR(std::sqrt(sum / count), 1.0, 0.03);
  EXPECT_GT(holes, 100);
  EXPECT_LT(holes, static_cast<int>(noisy.depth.size() / 10));
}

TEST(SimulatedRoom, MaskedPixelsAreThoseOfTheMovingObjects) {
  RoomConfig config = small_room();
  config.noise = false;
  const SimulatedRoom room(config);
  config.moving_objects = false;
  const Frame empty = SimulatedRoom(config).render(25);
  const Frame frame = room.render(25);
  int masked = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const int label = frame.mask(x, y);
      if (label == 0) {
        EXPECT_EQ(frame.depth(x, y), empty.depth(x, y));
        EXPECT_EQ(frame.color(x, y), empty.color(x, y));
        continue;
      }
      ++masked;
      const Eigen::Vector3d p = point_at(frame, room.truth(25).T_world_sensor, x, y);
      bool inside = false;
      for (const SimulatedObject& object : room.objects(25)) {
        const Eigen::Vector3d local = object.T_world_box.inverse() * p;
        inside |= label == 1 + static_cast<int>(object.object_class) &&
                  (local.cwiseAbs() - object.half_extent).maxCoeff() < 0.02;
      }
      EXPECT_TRUE(inside) << x << " " << y;
    }
  }
  EXPECT_GT(masked, 1000);
}

TEST(SimulatedRoom, ObjectsMoveWithTheirVelocity) {
  RoomConfig config;
  config.hz = 1000.0;
  const SimulatedRoom room(config);
  const auto before = room.objects(500);
  const auto after = room.objects(501);
  ASSERT_EQ(before.size(), 4U);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Eigen::Vector3d moved =
        after[i].T_world_box.translation() - before[i].T_world_box.translation();
    EXPECT_NEAR((moved * 1000.0 - before[i].velocity).norm(), 0.0, 2e-3);
    EXPECT_LT(before[i].velocity.norm(), 1.5);
  }
}

TEST(SimulatedRoom, AStillCameraStandsStill) {
  RoomConfig config = small_room();
  config.moving_camera = false;
  const SimulatedRoom room(config);
  EXPECT_TRUE(room.truth(100).T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace mms
