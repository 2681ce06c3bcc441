#include "mms/simulation/simulated_scene.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <string>

#include "mms/core/error.hpp"
#include "mms/geometry/camera.hpp"
#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {
namespace {

SceneConfig small(std::string_view name, int frames = 60) {
  SceneConfig config = scene_config(name);
  config.width = 320;
  config.frames = frames;
  return config;
}

SimulatedFrame rendered_by(int threads, const SceneConfig& config, int index) {
  SimulatedScene scene(config);
  SimulatedFrame frame;
  tbb::task_arena arena(threads);
  arena.execute([&] { frame = scene.render(index); });
  return frame;
}

/// World point of a pixel's exact depth.
Eigen::Vector3d point_at(const SimulatedScene& scene, const SimulatedFrame& frame, int x, int y) {
  const CameraModel camera(*frame.frame.calibration->camera);
  const auto z = static_cast<double>(frame.exact.depth(x, y));
  return scene.pose_at(frame.frame.stamp).T_world_sensor * Eigen::Vector3d(z * camera.ray({x, y}));
}

const ObjectTruth* largest(const SimulatedFrame& frame) {
  const ObjectTruth* found = nullptr;
  for (const ObjectTruth& object : frame.objects) {
    if (found == nullptr || object.pixels > found->pixels) found = &object;
  }
  return found;
}

void expect_same(const SimulatedFrame& a, const SimulatedFrame& b) {
  EXPECT_EQ(a.frame.color.pixels(), b.frame.color.pixels());
  EXPECT_EQ(a.frame.depth.pixels(), b.frame.depth.pixels());
  EXPECT_EQ(a.frame.mask.pixels(), b.frame.mask.pixels());
  EXPECT_EQ(a.exact.depth.pixels(), b.exact.depth.pixels());
}

TEST(SimulatedScene, SameFrameForAnyThreadCount) {
  SceneConfig config = small("crowd");
  config.blur_samples = 2;
  expect_same(rendered_by(1, config, 20), rendered_by(2, config, 20));
}

TEST(SimulatedScene, FramesAreIndependent) {
  SimulatedScene scene(small("warehouse_loop"));
  scene.render(3);
  scene.render(40);
  expect_same(scene.render(7), rendered_by(2, small("warehouse_loop"), 7));
}

TEST(SimulatedScene, SeedChangesScene) {
  SceneConfig other = small("static");
  other.seed = 2;
  EXPECT_NE(rendered_by(2, small("static"), 0).frame.color.pixels(),
            rendered_by(2, other, 0).frame.color.pixels());
}

TEST(SimulatedScene, EveryBuiltInSceneRenders) {
  for (const std::string_view name : scene_names()) {
    SimulatedScene scene(small(name));
    const SimulatedFrame frame = scene.render(30);
    int visible = 0;
    double brightness = 0.0;
    for (std::size_t i = 0; i < frame.exact.depth.size(); ++i) {
      visible += std::isfinite(frame.exact.depth[i]) ? 1 : 0;
      brightness += frame.frame.color[i].g;
    }
    const auto pixels = static_cast<double>(frame.exact.depth.size());
    EXPECT_EQ(visible, static_cast<int>(pixels)) << name << " has holes";
    EXPECT_GT(brightness / pixels, 40.0) << name;
    EXPECT_LT(brightness / pixels, 220.0) << name;
  }
}

TEST(SimulatedScene, OnlySomeScenesHaveActors) {
  for (const std::string_view name : scene_names()) {
    SimulatedScene scene(small(name));
    EXPECT_EQ(scene.render(0).objects.empty(), name == "static") << name;
  }
}

TEST(SimulatedScene, PointsReprojectByGroundTruthPose) {
  SimulatedScene scene(small("static"));
  const SimulatedFrame one = scene.render(10);
  const SimulatedFrame two = scene.render(13);
  const CameraModel camera(*one.frame.calibration->camera);
  const auto T_two_world = scene.truth(13).T_world_sensor.inverse();
  int checked = 0;
  for (int y = 8; y < 232; y += 8) {
    for (int x = 8; x < 312; x += 8) {
      // The same point in another view: the ground truth predicts its depth.
      const Eigen::Vector3d visible = T_two_world * point_at(scene, one, x, y);
      const Eigen::Vector2d pixel = camera.project(visible);
      const auto u = static_cast<int>(std::lround(pixel.x()));
      const auto v = static_cast<int>(std::lround(pixel.y()));
      if (!two.exact.depth.contains(u, v)) continue;
      const Eigen::Vector3d measured =
          static_cast<double>(two.exact.depth(u, v)) * camera.ray({u, v});
      if ((measured - visible).norm() > 0.05) continue;  // occluded
      EXPECT_LT((camera.project(measured) - Eigen::Vector2d(u, v)).norm(), 0.1);
      EXPECT_LT((measured - visible).norm(), 0.05);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(SimulatedScene, FloorDepthIsAnalytic) {
  // With the camera height known, every pixel of the bare floor has an exact depth.
  SceneConfig config = small("still_walker");
  config.camera_height = 1.2;
  SimulatedScene scene(config);
  const SimulatedFrame frame = scene.render(5);
  const CameraModel camera(*frame.frame.calibration->camera);
  const double pitch = 0.06;
  int exact = 0;
  int raised = 0;  // markings, pallets and cartons on the floor
  for (int y = 180; y < 240; y += 3) {
    for (int x = 0; x < 320; x += 3) {
      if (frame.frame.mask(x, y) != 0) continue;
      const Eigen::Vector3d ray = camera.ray({x, y});
      const double down = std::cos(pitch) * ray.y() + std::sin(pitch) * ray.z();
      const double error = static_cast<double>(frame.exact.depth(x, y)) - 1.2 / down;
      ++(std::abs(error) <= 1e-4 ? exact : raised);
    }
  }
  EXPECT_GT(exact, 1500);
  EXPECT_LT(raised, exact / 10);
}

TEST(SimulatedScene, WorldIsFirstFrame) {
  SimulatedScene scene(small("warehouse_loop"));
  EXPECT_TRUE(scene.truth(0).T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(scene.stamp(15).nanoseconds(), 1'000'000'000);
}

TEST(SimulatedScene, PosesBetweenFramesAreSmooth) {
  SimulatedScene scene(small("warehouse_loop"));
  const Eigen::Vector3d before = scene.pose_at(Timestamp(990'000'000)).T_world_sensor.translation();
  const Eigen::Vector3d center =
      scene.pose_at(Timestamp(1'000'000'000)).T_world_sensor.translation();
  const Eigen::Vector3d after =
      scene.pose_at(Timestamp(1'010'000'000)).T_world_sensor.translation();
  EXPECT_GT((after - before).norm(), 0.002);
  EXPECT_LT((after + before - 2.0 * center).norm(), 5e-4);
}

TEST(SimulatedScene, StillCameraDoesNotMove) {
  SimulatedScene scene(small("still_walker"));
  for (int i = 0; i < scene.size(); ++i) {
    EXPECT_TRUE(scene.truth(i).T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
  }
}

TEST(SimulatedScene, LoopClosesAfterAbout60Meters) {
  const SimulatedScene scene(scene_config("warehouse_loop"));
  double length = 0.0;
  double nearest_to_start = 1e9;
  for (int i = 1; i < scene.size(); ++i) {
    const Eigen::Vector3d current = scene.truth(i).T_world_sensor.translation();
    length += (current - scene.truth(i - 1).T_world_sensor.translation()).norm();
    if (length > 40.0) nearest_to_start = std::min(nearest_to_start, current.norm());
  }
  EXPECT_GT(length, 55.0);
  EXPECT_LT(length, 66.0);
  EXPECT_LT(nearest_to_start, 0.5);
}

TEST(SimulatedScene, VelocityIsDerivativeOfObjectPose) {
  SceneConfig config = small("warehouse_loop");
  config.hz = 1000.0;
  config.frames = 3000;
  SimulatedScene scene(config);
  const SimulatedFrame before = scene.render(1999);
  const SimulatedFrame current = scene.render(2000);
  const SimulatedFrame after = scene.render(2001);
  int moving = 0;
  for (std::size_t i = 0; i < current.objects.size(); ++i) {
    // The size of the box follows the limbs; its translation is that of the object.
    const Eigen::Vector3d slope =
        (after.objects[i].T_world_box.translation() - before.objects[i].T_world_box.translation()) /
        0.002;
    if (current.objects[i].object_class == ObjectClass::kAgv) {
      EXPECT_NEAR((slope - current.objects[i].velocity).norm(), 0.0, 0.35)
          << current.objects[i].kind;
    }
    EXPECT_EQ(current.objects[i].moving, current.objects[i].velocity.norm() > 0.05);
    moving += current.objects[i].moving ? 1 : 0;
  }
  EXPECT_GT(moving, 3);
}

TEST(SimulatedScene, BoxesContainTheirPixels) {
  SimulatedScene scene(small("crowd"));
  for (const int index : {5, 30, 55}) {
    const SimulatedFrame frame = scene.render(index);
    for (int y = 0; y < frame.exact.object.height(); ++y) {
      for (int x = 0; x < frame.exact.object.width(); ++x) {
        const int value = frame.exact.object(x, y);
        if (value == 0) continue;
        const ObjectTruth& object = frame.objects[static_cast<std::size_t>(value - 1)];
        const auto contains = [&](const PixelBox& box) {
          return x >= box.x && y >= box.y && x <= box.x + box.width && y <= box.y + box.height;
        };
        ASSERT_TRUE(contains(object.visible)) << index << " " << object.id;
        ASSERT_TRUE(contains(object.amodal)) << index << " " << object.id;
        const Eigen::Vector3d inside = object.T_world_box.inverse() * point_at(scene, frame, x, y);
        ASSERT_TRUE((inside.cwiseAbs() - object.half_extent).maxCoeff() < 1e-3)
            << index << " " << object.id;
      }
    }
  }
}

TEST(SimulatedScene, PixelsOcclusionAndClassesAreConsistent) {
  SimulatedScene scene(small("crowd"));
  const SimulatedFrame frame = scene.render(40);
  std::vector<int> count(frame.objects.size());
  for (std::size_t i = 0; i < frame.exact.object.size(); ++i) {
    const int value = frame.exact.object[i];
    if (value == 0) {
      EXPECT_EQ(frame.frame.mask[i], 0);
      continue;
    }
    const ObjectTruth& object = frame.objects[static_cast<std::size_t>(value - 1)];
    EXPECT_EQ(frame.frame.mask[i], 1 + static_cast<int>(object.object_class));
    ++count[static_cast<std::size_t>(value - 1)];
  }
  bool has_occluded_object = false;
  for (const ObjectTruth& object : frame.objects) {
    EXPECT_EQ(object.pixels, count[static_cast<std::size_t>(object.id)]);
    EXPECT_GE(object.occlusion, 0.0);
    EXPECT_LE(object.occlusion, 1.0);
    EXPECT_GE(object.truncation, -1e-9);
    EXPECT_LE(object.truncation, 1.0);
    has_occluded_object = has_occluded_object || (object.occlusion > 0.1 && object.pixels > 0);
  }
  EXPECT_TRUE(has_occluded_object);
}

TEST(SimulatedScene, StaticTruthIsCompleteInView) {
  SimulatedScene scene(small("warehouse_loop"));
  const double spacing = 0.04;
  const TruthCloud cloud = scene.static_cloud(spacing);
  ASSERT_EQ(cloud.points.size(), cloud.normals.size());
  VoxelHashMap<std::vector<Eigen::Vector3f>> voxels(spacing, 100'000'000);
  for (const Eigen::Vector3f& p : cloud.points) voxels.touch(voxels.key(p)).push_back(p);
  const auto is_near = [&](const Eigen::Vector3f& q) {
    const VoxelKey k = voxels.key(q);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto* points = voxels.find({k.x + dx, k.y + dy, k.z + dz});
          if (points == nullptr) continue;
          for (const Eigen::Vector3f& p : *points) {
            if ((p - q).norm() <= static_cast<float>(spacing)) return true;
          }
        }
      }
    }
    return false;
  };
  const SimulatedFrame frame = scene.render(20);
  int missing = 0;
  int all = 0;
  for (int y = 0; y < 240; y += 2) {
    for (int x = 0; x < 320; x += 2) {
      if (frame.exact.object(x, y) != 0) continue;
      ++all;
      missing += is_near(point_at(scene, frame, x, y).cast<float>()) ? 0 : 1;
    }
  }
  EXPECT_LT(missing, all / 1000) << "of " << all;
}

TEST(SimulatedScene, MotionBlurSmoothsMovingImage) {
  SceneConfig sharp = small("fast");
  sharp.blur_samples = 1;
  sharp.noise = false;
  SceneConfig blurred = sharp;
  blurred.blur_samples = 8;
  const auto roughness = [](const Image<Rgb>& image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 1; x < image.width(); ++x) {
        sum += std::abs(static_cast<double>(image(x, y).g) - image(x - 1, y).g);
      }
    }
    return sum;
  };
  const SimulatedFrame a = rendered_by(2, sharp, 39);
  const SimulatedFrame b = rendered_by(2, blurred, 39);
  EXPECT_LT(roughness(b.frame.color), 0.85 * roughness(a.frame.color));
  EXPECT_EQ(a.exact.depth.pixels(), b.exact.depth.pixels());
}

TEST(SimulatedScene, LidarPointsAreOnSurfaces) {
  SceneConfig config = small("static");
  config.sensor = 3;  // lidar16
  config.hz = 0.0;
  config.noise = false;
  SimulatedScene scene(config);
  ASSERT_TRUE(scene.sensor().lidar.has_value());
  const SimulatedFrame frame = scene.render(20);
  const LidarScan& scan = frame.frame.scan;
  ASSERT_GT(scan.points.size(), 10000U);
  ASSERT_EQ(scan.points.size(), scan.time_offset.size());
  ASSERT_EQ(scan.points.size(), frame.scan.points.size());
  ASSERT_EQ(scan.points.size(), frame.scan.labels.size());
  // The floor: camera_height below the camera, so a fixed height below the LiDAR's start.
  const double floor = -(scene.config().camera_height);
  const Eigen::Isometry3d T_lidar_camera = scene.sensor().T_camera_lidar.inverse();
  int on_floor = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Timestamp stamp =
        frame.frame.stamp + Duration(std::llround(1e9 * static_cast<double>(scan.time_offset[i])));
    const Eigen::Vector3d world =
        scene.pose_at(stamp).T_world_sensor * scan.points[i].cast<double>();
    const double height = world.z() - T_lidar_camera.translation().z() - floor;
    EXPECT_GT(height, -0.35);
    ASSERT_LT((world - frame.scan.points[i].cast<double>()).norm(), 1e-3);
    EXPECT_EQ(frame.scan.labels[i], 0);
    on_floor += std::abs(height) < 0.35 && scan.points[i].norm() < 5.0F ? 1 : 0;
  }
  EXPECT_GT(on_floor, 500);
  EXPECT_GT(scan.time_offset.back(), 0.09F);
}

TEST(SimulatedScene, FewerFramesKeepWorld) {
  SceneConfig config = scene_config("warehouse_loop");
  config.width = 64;
  SimulatedScene whole(config);
  config.frames = 5;
  SimulatedScene part(config);
  EXPECT_EQ(whole.size(), 960);
  EXPECT_EQ(part.size(), 5);
  expect_same(whole.render(4), part.render(4));
}

TEST(SceneConfig, ErrorListsKnownNames) {
  try {
    scene_config("werehouse");
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("warehouse_loop, still_walker, crowd"),
              std::string::npos)
        << error.what();
  }
}

TEST(SimulatedScene, WalkerHasSizeOfPerson) {
  SimulatedScene scene(small("still_walker", 150));
  int visible = 0;
  for (int index = 0; index < 150; index += 15) {
    const SimulatedFrame frame = scene.render(index);
    const ObjectTruth* walker = largest(frame);
    ASSERT_NE(walker, nullptr);
    EXPECT_EQ(walker->object_class, ObjectClass::kPerson);
    EXPECT_GT(2.0 * walker->half_extent.z(), 1.4);
    EXPECT_LT(2.0 * walker->half_extent.z(), 2.1);
    visible += walker->pixels > 500 ? 1 : 0;
  }
  EXPECT_GE(visible, 5);
}

}  // namespace
}  // namespace mms
