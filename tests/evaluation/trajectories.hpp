#pragma once

#include <random>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/geometry/se3.hpp"

namespace mms::test {

inline constexpr Duration kPeriod = std::chrono::milliseconds(100);

inline Eigen::Isometry3d random_isometry(std::mt19937& random, double translation, double angle) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector6d tangent;
  for (int i = 0; i < 6; ++i) tangent[i] = (i < 3 ? translation : angle) * uniform(random);
  return se3::exp(tangent);
}

/// A smooth random walk at 10 Hz that starts at the stamp 100 s.
inline Trajectory random_walk(std::mt19937& random, int count) {
  Trajectory trajectory;
  Transform<World, Sensor> pose;
  for (int i = 0; i < count; ++i) {
    trajectory.push_back({Timestamp(100'000'000'000) + i * kPeriod, pose});
    pose = pose * Transform<Sensor, Sensor>(random_isometry(random, 0.1, 0.05));
  }
  return trajectory;
}

/// The trajectory in another world frame: `T_other_world` before every pose.
inline Trajectory moved(const Trajectory& trajectory, const Eigen::Isometry3d& T_other_world) {
  Trajectory result = trajectory;
  for (StampedPose& pose : result) {
    pose.T_world_sensor = Transform<World, World>(T_other_world) * pose.T_world_sensor;
  }
  return result;
}

/// No rotation, 10 Hz from the stamp 0, the given positions along x [m].
inline Trajectory along_x(const std::vector<double>& positions) {
  Trajectory trajectory;
  for (const double x : positions) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = x;
    const auto count = static_cast<std::int64_t>(trajectory.size());
    trajectory.push_back({Timestamp() + count * kPeriod, Transform<World, Sensor>(pose)});
  }
  return trajectory;
}

}  // namespace mms::test
