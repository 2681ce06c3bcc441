#include "mms/localization/registration/residuals.hpp"

namespace mms {

ScalarResidual point_to_plane(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& point,
                              const Eigen::Vector3d& on_plane, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d normal_in_sensor = T_world_sensor.linear().transpose() * normal;
  ScalarResidual r;
  r.value = normal.dot(T_world_sensor * point - on_plane);
  r.jacobian.head<3>() = normal_in_sensor;
  r.jacobian.tail<3>() = point.cross(normal_in_sensor);
  return r;
}

VectorResidual point_to_line(const Eigen::Isometry3d& T_world_sensor, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& on_line, const Eigen::Vector3d& direction) {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  const Eigen::Matrix3d rotated = across * T_world_sensor.linear();
  VectorResidual r;
  r.value = across * (T_world_sensor * point - on_line);
  r.jacobian.leftCols<3>() = rotated;
  r.jacobian.rightCols<3>() = -rotated * se3::hat(point);
  return r;
}

}  // namespace mms
