#pragma once

#include <cmath>
#include <memory>

#include "mms/simulation/simulated_scene.hpp"

namespace mms::testing {

inline constexpr int kObjectId = 4;

/// A depth camera of 32 x 24 px, or a LiDAR with such a camera beside it.
inline SensorPreset small_sensor(bool lidar = false) {
  SensorPreset sensor = sensor_preset(lidar ? "lidar16" : "d435");
  sensor.color.intrinsics = {40.0, 40.0, 15.5, 11.5, 32, 24, {}};
  sensor.depth_scale = 1000.0;
  sensor.T_camera_lidar = Eigen::Isometry3d::Identity();
  if (lidar) sensor.T_camera_lidar.translation().x() = 0.25;
  return sensor;
}

/// Frame `index` at 10 Hz: a wall at 2 m and a person at 1 m in front of its left half. The
/// measured depth is 1 cm too large, and the top row has no return.
inline SimulatedFrame synthetic_frame(int index, const SensorPreset& sensor) {
  const CameraIntrinsics& camera = sensor.color.intrinsics;
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = camera;
  calibration->T_camera_lidar = Transform<Camera, Lidar>(sensor.T_camera_lidar);
  SimulatedFrame simulated;
  Frame& frame = simulated.frame;
  frame.index = index;
  frame.stamp = Timestamp(100'000'000 * std::int64_t{index} + 1);
  frame.calibration = calibration;
  frame.color = Image<Rgb>(camera.width, camera.height, Rgb{200, 150, 100});
  frame.mask = Image<std::uint8_t>(camera.width, camera.height);
  simulated.exact.depth = Image<float>(camera.width, camera.height, 2.0F);
  simulated.exact.object = Image<std::uint8_t>(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width / 2; ++x) {
      simulated.exact.depth(x, y) = 1.0F;
      simulated.exact.object(x, y) = 1 + kObjectId;
      frame.mask(x, y) = 1;
    }
  }
  if (sensor.lidar) {
    frame.scan.points = {{1.0F, 0.5F, 0.0F}, {2.0F, 0.0F, static_cast<float>(index)}};
    frame.scan.intensity = {0.5F, 0.25F};
    frame.scan.time_offset = {0.0F, 0.05F};
  } else {
    frame.depth = simulated.exact.depth;
    for (float& depth : frame.depth.pixels()) depth += 0.01F;
    for (int x = 0; x < camera.width; ++x) frame.depth(x, 0) = 0.0F;
  }
  ObjectTruth person;
  person.id = kObjectId;
  person.kind = "person";
  person.half_extent = {0.25, 0.3, 0.9};
  person.velocity = {1.0, 0.0, 0.0};
  person.moving = true;
  person.visible = {0.0, 0.0, camera.width / 2.0, 1.0 * camera.height};
  person.amodal = {-4.0, 0.0, 4.0 + camera.width / 2.0, 1.0 * camera.height};
  person.pixels = camera.width / 2 * camera.height;
  ObjectTruth vehicle;  // behind the camera
  vehicle.id = 2;
  vehicle.object_class = ObjectClass::kAgv;
  vehicle.kind = "forklift";
  simulated.objects = {person, vehicle};
  return simulated;
}

/// Pose of that frame; it moves 10 cm to the right per frame.
inline StampedPose synthetic_pose(int index, const SensorPreset& sensor) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = 0.1 * index;
  return {synthetic_frame(index, sensor).frame.stamp, Transform<World, Sensor>(pose)};
}

}  // namespace mms::testing
