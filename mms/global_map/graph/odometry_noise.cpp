#include "mms/global_map/graph/odometry_noise.hpp"

#include <numbers>

namespace mms {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Standard deviations of a motion. Source: over 60 m of `warehouse_loop` in steps of 0.25 m they
/// give 2.6 cm and 0.5 degrees; the odometry of eleven seeds is off by 1 to 4.5 cm.
constexpr double kTranslation = 0.001;          // [m]
constexpr double kTranslationShare = 0.003;     // of the translation
constexpr double kTranslationPerAngle = 0.005;  // [m/rad]
constexpr double kRotation = 0.03 * kDegree;    // [rad]
constexpr double kRotationShare = 0.005;        // of the rotation

/// The same after the sensor was lost. Source: initial choice, a person's pace for some seconds.
constexpr double kLostTranslation = 3.0;          // [m]
constexpr double kLostRotation = 60.0 * kDegree;  // [rad]

}  // namespace

Matrix6d odometry_information(const Eigen::Isometry3d& motion, bool after_lost) {
  const double way = motion.translation().norm();
  const double angle = se3::angle(motion);
  const double translation =
      after_lost ? kLostTranslation
                 : kTranslation + kTranslationShare * way + kTranslationPerAngle * angle;
  const double rotation = after_lost ? kLostRotation : kRotation + kRotationShare * angle;
  Vector6d information;
  information.head<3>().setConstant(1.0 / (translation * translation));
  information.tail<3>().setConstant(1.0 / (rotation * rotation));
  return information.asDiagonal();
}

}  // namespace mms
