#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/camera.hpp"

namespace mms::test {

inline CameraIntrinsics small_camera() {
  CameraIntrinsics camera;
  camera.fx = camera.fy = 130.0;
  camera.cx = 79.5;
  camera.cy = 59.5;
  camera.width = 160;
  camera.height = 120;
  return camera;
}

/// Depth along z of the ray with z = 1 at pixel (x, y); 0 for no return.
using DepthOf = std::function<float(int x, int y, const Eigen::Vector3f& ray)>;

/// Organised cloud of static points with that depth.
inline LabeledCloud organised_cloud(const DepthOf& depth_of) {
  LabeledCloud cloud;
  cloud.camera = small_camera();
  cloud.width = cloud.camera.width;
  cloud.height = cloud.camera.height;
  const std::vector<Eigen::Vector3f> rays = CameraModel(cloud.camera).ray_table();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const int x = static_cast<int>(i) % cloud.width;
    const int y = static_cast<int>(i) / cloud.width;
    const float z = depth_of(x, y, rays[i]);
    cloud.points.push_back(z > 0.0F ? Eigen::Vector3f(z * rays[i])
                                    : Eigen::Vector3f::Constant(NAN));
    cloud.labels.push_back(z > 0.0F ? PointLabel::kStatic : PointLabel::kInvalid);
    cloud.colors.push_back({100, 150, 200});
  }
  cloud.cluster.assign(cloud.points.size(), -1);
  return cloud;
}

/// View of the world's plane normal . p = offset by a camera at that pose.
inline LabeledCloud plane_cloud(const Eigen::Vector3d& normal, double offset,
                                const Transform<World, Sensor>& T_world_sensor) {
  const Eigen::Vector3d n = T_world_sensor.rotation().transpose() * normal;
  const double d = offset - normal.dot(T_world_sensor.translation());
  return organised_cloud([&](int, int, const Eigen::Vector3f& ray) {
    return static_cast<float>(d / n.dot(ray.cast<double>()));
  });
}

inline std::size_t dynamic_points(const LabeledCloud& cloud) {
  return static_cast<std::size_t>(
      std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic));
}

inline Transform<World, Sensor> pose(const Eigen::Vector3d& translation, double yaw = 0.0) {
  return Transform<World, Sensor>(Eigen::Translation3d(translation) *
                                  Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
                                  Eigen::Isometry3d::Identity());
}

}  // namespace mms::test
