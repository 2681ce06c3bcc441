#include "mms/mapping/ground/floor_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

/// [s]: least time from one search to the next. Source: bounds the time; every fifth frame of the
/// simulated scenes at 15 Hz.
constexpr double kMinInterval = 0.3;

/// [-]: points of a search. Source: bounds the time; a floor patch at 4 m still has a dozen.
constexpr std::size_t kMaxPoints = 6000;

/// [m]: range of the points. Source: the Kinect's depth noise is 0.1 m there.
constexpr float kMaxRange = 8.0F;

/// [s]: time constant of the average. Source: 20 searches at the 15 Hz of the simulated scenes,
/// which reduce the error of one to less than a quarter.
constexpr double kAveragingTime = 6.5;

/// [m]: height above the floor from which a level surface is an object. Source: below a stair's
/// step of 0.17 m.
constexpr double kMaxRise = 0.15;

/// [deg]: angle between two estimates of a floor. Source: above their errors of about a degree,
/// below the slope of a ramp.
constexpr double kMaxTilt = 5.0;

/// [s]: time of rejections after which the floor is replaced. Source: ten searches at 15 Hz; people
/// and tables cover the floor for less.
constexpr double kMaxRejectionTime = 2.9;

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
  if (last_search_ && to_seconds(cloud.stamp - *last_search_) < kMinInterval) return;
  last_search_ = cloud.stamp;
  const Floor seen =
      find_floor(static_points(cloud, T_world_sensor), floor_ ? floor_->up : up, config_);
  const Eigen::Vector3d sensor = T_world_sensor.translation();
  const bool is_ceiling = seen.up.dot(sensor) < seen.height;
  if (seen.found && !is_ceiling) follow(seen, sensor, cloud.stamp);
}

void FloorTracker::follow(const Floor& seen, const Eigen::Vector3d& sensor, Timestamp stamp) {
  const Eigen::Vector3d foot = sensor - (seen.up.dot(sensor) - seen.height) * seen.up;
  const double rise = floor_ ? floor_->up.dot(foot) - floor_->height : 0.0;
  const double cosine = floor_ ? floor_->up.dot(seen.up) : 1.0;
  const bool is_tilted = cosine < std::cos(kMaxTilt * std::numbers::pi / 180.0);
  const bool is_rejected = is_tilted || rise > kMaxRise;
  if (is_rejected) {
    if (!rejected_since_) rejected_since_ = stamp;
    if (to_seconds(stamp - *rejected_since_) < kMaxRejectionTime) return;
  }
  // A lower floor, or one that was found repeatedly, replaces the last.
  if (is_rejected || rise < -kMaxRise) averaged_ = 0;
  rejected_since_.reset();
  if (++averaged_ == 1) floor_ = seen;
  const double forgotten = 1.0 - std::exp(-to_seconds(stamp - last_floor_) / kAveragingTime);
  const double gain = std::max(1.0 / averaged_, forgotten);
  last_floor_ = stamp;
  floor_->up = (floor_->up + gain * (seen.up - floor_->up)).normalized();
  floor_->height = floor_->up.dot(foot) - (1.0 - gain) * rise;
}

}  // namespace mms
