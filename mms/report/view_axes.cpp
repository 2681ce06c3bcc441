#include "mms/report/view_axes.hpp"

#include <Eigen/Geometry>

namespace mms {

ViewAxes view_axes(Viewpoint viewpoint, UpAxis up) {
  const bool camera = up == UpAxis::kNegativeY;
  const bool top = viewpoint == Viewpoint::kTop;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  ViewAxes axes;
  axes.right = camera || top ? x : Eigen::Vector3d(-y);
  axes.up = camera ? (top ? z : Eigen::Vector3d(-y)) : (top ? y : z);
  axes.to_viewer = axes.right.cross(axes.up);
  return axes;
}

double height(const Eigen::Vector3d& point, UpAxis up) {
  return up == UpAxis::kNegativeY ? -point.y() : point.z();
}

}  // namespace mms
