#include "mms/mapping/static_map/keyframe_selector.hpp"

#include <numbers>

#include "mms/geometry/se3.hpp"

namespace mms {

bool KeyframeSelector::is_keyframe(const OdometryEstimate& odometry) {
  if (odometry.status == Status::kLost || !odometry.T_world_sensor.is_finite()) return false;
  if (last_ && !far_from_last(odometry)) return false;
  last_ = odometry;
  return true;
}

bool KeyframeSelector::far_from_last(const OdometryEstimate& odometry) const {
  const Transform<Sensor, Sensor> motion =
      last_->T_world_sensor.inverse() * odometry.T_world_sensor;
  const double turned = se3::angle(motion.isometry()) * 180.0 / std::numbers::pi;
  return motion.translation().norm() > config_.translation || turned > config_.rotation ||
         to_seconds(odometry.stamp - last_->stamp) >= config_.max_interval;
}

}  // namespace mms
