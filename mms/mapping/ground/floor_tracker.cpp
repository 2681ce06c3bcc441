#include "mms/mapping/ground/floor_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

constexpr int kEvery = 5;                 // frames
constexpr std::size_t kMaxPoints = 6000;  // of a frame
constexpr float kMaxRange = 8.0F;         // of a point [m]
constexpr int kMemory = 20;               // floors averaged
constexpr double kHigher = 0.15;          // from which a surface is a table, not the floor [m]
constexpr double kMaxTurn = 5.0;          // between two floors [deg]
constexpr int kStubborn = 10;             // rejected in a row that are right after all

MapCloud static_points(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) {
  const std::size_t stride = 1 + cloud.points.size() / kMaxPoints;
  const Eigen::Vector3f origin = T_world_sensor.translation().cast<float>();
  const Eigen::Matrix3f rotation = T_world_sensor.rotation().cast<float>();
  MapCloud map;
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (cloud.labels[i] != PointLabel::kStatic || cloud.points[i].norm() > kMaxRange) continue;
    map.points.emplace_back(rotation * cloud.points[i] + origin);
  }
  map.normals.assign(map.points.size(), Eigen::Vector3f::Zero());
  return map;
}

}  // namespace

void FloorTracker::update(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor,
                          const Eigen::Vector3d& up) {
  if (frames_++ % kEvery != 0) return;
  const Floor seen =
      find_floor(static_points(cloud, T_world_sensor), floor_ ? floor_->up : up, config_);
  const Eigen::Vector3d sensor = T_world_sensor.translation();
  const bool is_ceiling = seen.up.dot(sensor) < seen.height;
  if (seen.found && !is_ceiling) follow(seen, sensor);
}

void FloorTracker::follow(const Floor& seen, const Eigen::Vector3d& sensor) {
  const Eigen::Vector3d foot = sensor - (seen.up.dot(sensor) - seen.height) * seen.up;
  const double higher = floor_ ? floor_->up.dot(foot) - floor_->height : 0.0;
  const double cosine = floor_ ? floor_->up.dot(seen.up) : 1.0;
  const bool is_turned = cosine < std::cos(kMaxTurn * std::numbers::pi / 180.0);
  if ((is_turned || higher > kHigher) && ++rejected_ < kStubborn) return;
  // A floor that lies lower, or that was seen again and again, takes the place of the last.
  if (rejected_ >= kStubborn || higher < -kHigher) seen_ = 0;
  rejected_ = 0;
  seen_ = std::min(seen_ + 1, kMemory);
  const double gain = 1.0 / seen_;
  if (seen_ == 1) floor_ = seen;
  floor_->up = (floor_->up + gain * (seen.up - floor_->up)).normalized();
  floor_->height = floor_->up.dot(foot) - (1.0 - gain) * higher;
}

}  // namespace mms
