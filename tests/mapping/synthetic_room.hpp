#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms::test {

struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  PointLabel label = PointLabel::kStatic;
};

/// A box-shaped room, z up, floor at z = 0, with boxes in it.
struct Room {
  Eigen::Vector3d low{-3.0, -2.0, 0.0};
  Eigen::Vector3d high{3.0, 2.0, 2.5};
  std::vector<Box> boxes{};

  /// End of a ray from inside as a multiple of `ray`, and the label of what it hits.
  std::pair<double, PointLabel> hit(const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& ray) const {
    double end = crossing(origin, ray, low, high).second;
    PointLabel label = PointLabel::kStatic;
    for (const Box& box : boxes) {
      const auto [enter, leave] = crossing(origin, ray, box.low, box.high);
      if (enter > leave || enter <= 0.0 || enter >= end) continue;
      end = enter;
      label = box.label;
    }
    return {end, label};
  }

 private:
  static std::pair<double, double> crossing(const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& ray, const Eigen::Vector3d& low,
                                            const Eigen::Vector3d& high) {
    const Eigen::Array3d a = (low - origin).array() / ray.array();
    const Eigen::Array3d b = (high - origin).array() / ray.array();
    return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
  }
};

struct RoomFrame {};

/// A camera at `position`, turned left by `yaw` from the room's x axis and down by `pitch` [rad].
inline Transform<RoomFrame, Sensor> camera_in_room(const Eigen::Vector3d& position, double yaw,
                                                   double pitch = 0.0) {
  Eigen::Matrix3d level;
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // forward is x, right is -y, down is -z
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * level *
               Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX());
  T.translation() = position;
  return Transform<RoomFrame, Sensor>(T);
}

/// View of the room by the small camera.
inline LabeledCloud view(const Room& room, const Transform<RoomFrame, Sensor>& T_room_sensor) {
  std::vector<PointLabel> labels;
  LabeledCloud cloud = organised_cloud([&](int, int, const Eigen::Vector3f& ray) {
    const auto [depth, label] =
        room.hit(T_room_sensor.translation(), T_room_sensor.rotation() * ray.cast<double>());
    labels.push_back(label);
    return static_cast<float>(depth);
  });
  cloud.labels = labels;
  return cloud;
}

/// Scan of the room by a LiDAR of 32 rings with its z axis up.
inline LabeledCloud scan(const Room& room, const Eigen::Vector3d& position) {
  LabeledCloud cloud;
  for (int ring = -16; ring < 16; ++ring) {
    for (int column = 0; column < 720; ++column) {
      const double azimuth = 2.0 * std::numbers::pi * (column + 0.3) / 720.0;
      const double elevation = (ring + 0.5) * 2.0 * std::numbers::pi / 180.0;
      const Eigen::Vector3d ray(std::cos(azimuth) * std::cos(elevation),
                                std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      const auto [range, label] = room.hit(position, ray);
      cloud.points.emplace_back((range * ray).cast<float>());
      cloud.labels.push_back(label);
    }
  }
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = 1;
  cloud.cluster.assign(cloud.points.size(), -1);
  return cloud;
}

}  // namespace mms::test
