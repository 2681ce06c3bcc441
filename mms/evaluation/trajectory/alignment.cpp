#include "mms/evaluation/trajectory/alignment.hpp"

#include <Eigen/SVD>
#include <string>

#include "mms/core/error.hpp"

namespace mms {
namespace {

Eigen::Vector3d centroid(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Closest rotation to a matrix, det = +1 also for mirrored or planar points.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

Eigen::Isometry3d align_points(const std::vector<Eigen::Vector3d>& source,
                               const std::vector<Eigen::Vector3d>& target) {
  if (source.size() != target.size() || source.size() < 3) {
    throw DataError("alignment", std::to_string(source.size()) + " and " +
                                     std::to_string(target.size()) +
                                     " positions, expected at least 3 matched pairs");
  }
  const Eigen::Vector3d source_centre = centroid(source);
  const Eigen::Vector3d target_centre = centroid(target);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    covariance += (target[i] - target_centre) * (source[i] - source_centre).transpose();
  }
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.linear() = nearest_rotation(covariance);
  T_target_source.translation() = target_centre - T_target_source.linear() * source_centre;
  return T_target_source;
}

Eigen::Isometry3d align_poses(const std::vector<Eigen::Isometry3d>& source,
                              const std::vector<Eigen::Isometry3d>& target) {
  if (source.size() != target.size() || source.empty()) {
    throw DataError("alignment", std::to_string(source.size()) + " and " +
                                     std::to_string(target.size()) +
                                     " poses, expected at least one matched pair");
  }
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    rotations += target[i].linear() * source[i].linear().transpose();
  }
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.linear() = nearest_rotation(rotations);
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    offset += target[i].translation() - T_target_source.linear() * source[i].translation();
  }
  T_target_source.translation() = offset / static_cast<double>(source.size());
  return T_target_source;
}

}  // namespace mms
