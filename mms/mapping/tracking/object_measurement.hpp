#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/ground/ground_frame.hpp"
#include "mms/mapping/tracking/appearance.hpp"
#include "mms/mapping/tracking/track_config.hpp"

namespace mms {

/// One dynamic object of a frame, in the world frame.
struct ObjectMeasurement {
  Timestamp stamp;
  ObjectClass object_class = ObjectClass::kPerson;
  /// Of its mask, in (0, 1]; 0 without one, or where recent views contradict it.
  float score = 1.0F;
  int instance = -1;                                 ///< of its mask; -1 without one
  bool largest = true;                               ///< of the clusters under its mask
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< the sensor's position [m]
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< the image's axis to the right
  std::vector<Eigen::Vector3d> points;               ///< a few hundred, evenly chosen; never empty
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Appearance appearance;  ///< empty without colours

  /// Sides where the object may continue unseen: beyond the image's border or behind an occluder.
  struct Truncation {
    bool left = false;
    bool right = false;
    bool top = false;
    bool bottom = false;
    bool any() const { return left || right || top || bottom; }
  } truncation;
};

/// Measures the clusters of `cloud` in their order, of which the first under a mask is its largest,
/// each divided into the objects it holds. Clusters without points are left out. Truncations are
/// known for organised clouds only. Without a floor the lowest point of an object is assumed on it.
std::vector<ObjectMeasurement> measure_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor,
                                               const GroundFrame& ground,
                                               const TrackConfig& config);

}  // namespace mms
