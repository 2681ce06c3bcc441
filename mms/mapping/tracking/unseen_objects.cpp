#include "mms/mapping/tracking/unseen_objects.hpp"

namespace mms {
namespace {

/// [m]: height over the floor up to which points belong to it. Source: three standard deviations of
/// the Kinect's depth noise at 3.6 m.
constexpr float kFloorClearance = 0.06F;

/// The box of an object above the floor it stands on, for points in the sensor frame.
class ExpectedBox {
 public:
  ExpectedBox(const ObjectBox& box, const Transform<World, Sensor>& T_world_sensor)
      : T_box_sensor_((box.T_world_box.inverse() * T_world_sensor.isometry()).cast<float>()),
        half_((0.5 * box.size.array()).cast<float>()),
        lowest_(kFloorClearance - static_cast<float>(0.5 * box.size.z())) {}

  bool contains(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f local = T_box_sensor_ * point;
    return local.z() > lowest_ && (local.array().abs() <= half_).all();
  }

 private:
  Eigen::Isometry3f T_box_sensor_;
  Eigen::Array3f half_;
  float lowest_;
};

std::size_t mask(const ExpectedBox& box, LabeledCloud& cloud) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != PointLabel::kStatic || !box.contains(cloud.points[i])) continue;
    cloud.labels[i] = PointLabel::kDynamic;
    ++count;
  }
  return count;
}

}  // namespace

std::size_t mask_unseen_objects(const std::vector<TrackedObject>& objects,
                                const Transform<World, Sensor>& T_world_sensor,
                                LabeledCloud& cloud) {
  std::size_t count = 0;
  for (const TrackedObject& object : objects) {
    if (object.state != TrackState::kCoasting) continue;
    count += mask(ExpectedBox(object.box, T_world_sensor), cloud);
  }
  return count;
}

}  // namespace mms
