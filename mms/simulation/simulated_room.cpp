#include "mms/simulation/simulated_room.hpp"

#include "mms/simulation/camera_noise.hpp"
#include "mms/simulation/camera_path.hpp"
#include "mms/simulation/furniture.hpp"
#include "mms/simulation/hash_noise.hpp"
#include "mms/simulation/ray_caster.hpp"
#include "mms/simulation/shading.hpp"

namespace mms {
namespace {

/// A Kinect-like camera: 63 degrees wide at 4 : 3.
std::shared_ptr<const Calibration> room_calibration(const RoomConfig& config) {
  CameraIntrinsics camera;
  camera.fx = camera.fy = 525.0 / 640.0 * config.width;
  camera.cx = 0.5 * (config.width - 1);
  camera.cy = 0.5 * (config.height - 1);
  camera.width = config.width;
  camera.height = config.height;
  auto calibration = std::make_shared<Calibration>();
  calibration->camera = camera;
  return calibration;
}

Image<std::uint8_t> mask_of(const CastImage& cast, const std::vector<Solid>& solids) {
  Image<std::uint8_t> mask(cast.solid.width(), cast.solid.height());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (cast.solid[i] >= 0) mask[i] = solids[static_cast<std::size_t>(cast.solid[i])].label;
  }
  return mask;
}

/// The exact depth, with 0 instead of infinity.
Image<float> exact_depth(const CastImage& cast, double max_depth) {
  Image<float> depth = cast.depth;
  for (float& z : depth.pixels()) z = z <= static_cast<float>(max_depth) ? z : 0.0F;
  return depth;
}

}  // namespace

SimulatedRoom::SimulatedRoom(const RoomConfig& config)
    : config_(config),
      calibration_(room_calibration(config)),
      furniture_(furnished_room(static_cast<std::uint32_t>(config.seed))) {
  if (!config.moving_objects) return;
  movers_ = mms::moving_objects(config.people, static_cast<std::uint32_t>(config.seed));
}

Eigen::Isometry3d SimulatedRoom::T_room_camera(int index) const {
  return camera_path(config_.moving_camera ? seconds(index) : 0.0);
}

std::vector<Solid> SimulatedRoom::solids(int index) const {
  std::vector<Solid> all = furniture_;
  for (const MovingObject& mover : movers_) {
    const std::vector<Solid> body = mover.solids(seconds(index));
    all.insert(all.end(), body.begin(), body.end());
  }
  return all;
}

Frame SimulatedRoom::render(int index) const {
  const std::vector<Solid> all = solids(index);
  const CameraIntrinsics& camera = *calibration_->camera;
  const Eigen::Isometry3d T = T_room_camera(index);
  const CastImage cast = cast_rays(all, camera, T);
  const std::uint64_t key =
      hash_of(static_cast<std::uint64_t>(config_.seed), static_cast<std::uint64_t>(index));
  Frame frame;
  frame.index = index;
  frame.stamp = stamp(index);
  frame.name = "room_" + std::to_string(index);
  frame.calibration = calibration_;
  frame.mask = mask_of(cast, all);
  frame.color = shade(cast, all, camera, T);
  if (config_.noise) {
    add_color_noise(frame.color, 2.0, hash_of(key, 1));
    frame.depth = measured_depth(cast, all, camera, T, config_.max_depth, hash_of(key, 2));
  } else {
    frame.depth = exact_depth(cast, config_.max_depth);
  }
  return frame;
}

StampedPose SimulatedRoom::truth(int index) const {
  const Eigen::Isometry3d T_world_camera = T_room_camera(0).inverse() * T_room_camera(index);
  return {stamp(index), Transform<World, Sensor>(T_world_camera)};
}

std::vector<SimulatedObject> SimulatedRoom::objects(int index) const {
  const Eigen::Isometry3d T_world_room = T_room_camera(0).inverse();
  std::vector<SimulatedObject> result;
  for (const MovingObject& mover : movers_) {
    SimulatedObject object;
    object.id = static_cast<int>(result.size());
    object.object_class = mover.object_class;
    object.half_extent = mover.half_extent();
    object.T_world_box = T_world_room * mover.T_room_object(seconds(index)) *
                         Eigen::Translation3d(0.0, 0.0, object.half_extent.z());
    const Eigen::Vector2d v = mover.velocity(seconds(index));
    object.velocity = T_world_room.linear() * Eigen::Vector3d(v.x(), v.y(), 0.0);
    result.push_back(object);
  }
  return result;
}

}  // namespace mms
