#include "mms/global_map/graph/odometry_noise.hpp"

#include <numbers>

namespace mms {
namespace {

/// [m]: least standard deviation of a translation. Source: over 60 m of `warehouse_loop` in steps
/// of 0.25 m, all of these give 2.6 cm and 0.5 degrees; eleven seeds are off by 1 to 4.5 cm.
constexpr double kTranslation = 0.001;

/// [-]: what the translation adds, as a share of it. Source: as `kTranslation`.
constexpr double kTranslationShare = 0.003;

/// [m/rad]: what the rotation adds to it. Source: as `kTranslation`.
constexpr double kTranslationPerAngle = 0.005;

/// [rad]: least standard deviation of a rotation. Source: as `kTranslation`; 0.03 degrees.
constexpr double kRotation = 0.03 * std::numbers::pi / 180.0;

/// [-]: what the rotation adds, as a share of it. Source: as `kTranslation`.
constexpr double kRotationShare = 0.005;

/// [m]: standard deviation of a translation after the sensor was lost. Source: initial choice, a
/// walking person for some seconds.
constexpr double kLostTranslation = 3.0;

/// [rad]: the same of a rotation. Source: initial choice, 60 degrees.
constexpr double kLostRotation = std::numbers::pi / 3.0;

/// [m]: standard deviation of a translation between worlds. Source: larger than any map.
constexpr double kUnknownTranslation = 1e5;

/// [rad]: the same of a rotation. Source: larger than any turn.
constexpr double kUnknownRotation = 1e3;

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

Matrix6d unknown_motion_information() {
  Vector6d information;
  information.head<3>().setConstant(1.0 / (kUnknownTranslation * kUnknownTranslation));
  information.tail<3>().setConstant(1.0 / (kUnknownRotation * kUnknownRotation));
  return information.asDiagonal();
}

}  // namespace mms
