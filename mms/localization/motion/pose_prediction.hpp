#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "mms/geometry/normal_equations.hpp"

namespace mms {

/// Expected pose of a frame before it is registered.
struct PosePrediction {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
  double translation_sigma = kUnknown;  ///< standard deviation along each axis [m]
  double rotation_sigma = kUnknown;     ///< about each axis [rad]
  bool is_sensed = false;               ///< by wheels or a gyroscope

  bool is_informative() const { return translation_sigma < kUnknown || rotation_sigma < kUnknown; }
  bool is_complete() const { return translation_sigma < kUnknown && rotation_sigma < kUnknown; }

  /// Of the deviation log(T_world_sensor^-1 pose), assumed small: its derivative is identity.
  NormalEquations equations(const Eigen::Isometry3d& pose) const {
    Vector6d weight;
    weight.head<3>().setConstant(1.0 / (translation_sigma * translation_sigma));
    weight.tail<3>().setConstant(1.0 / (rotation_sigma * rotation_sigma));
    const Vector6d residual = se3::log(T_world_sensor.inverse() * pose);
    NormalEquations equations;
    equations.information = weight.asDiagonal();
    equations.gradient = weight.cwiseProduct(residual);
    equations.cost = residual.dot(equations.gradient);
    return equations;
  }
};

}  // namespace mms
