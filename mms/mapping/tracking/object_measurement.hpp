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
  float score = 1.0F;                                ///< of its mask, in (0, 1]; 0 without one
  int instance = -1;                                 ///< of its mask; -1 without one
  bool largest = true;                               ///< of what its mask covers
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< where it was seen from [m]
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< the image's axis to the right
  std::vector<Eigen::Vector3d> points;               ///< a few hundred, evenly chosen; never empty
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Appearance appearance;  ///< empty without colours

  /// Where the object may go on unseen: at the image's border, or behind something nearer.
  struct Truncation {
    bool left = false;
    bool right = false;
    bool top = false;
    bool bottom = false;
    bool any() const { return left || right || top || bottom; }
  } truncation;
};

/// Measures the clusters of `cloud` in their order, of which the first under a mask is its largest,
/// each as the objects it holds. Cuts are known of organised clouds only. Clusters that list no
/// points of theirs (as in tests) are taken for the corners of their boxes. Without a floor the
/// lowest point of an object is taken to stand on it.
std::vector<ObjectMeasurement> measure_objects(const LabeledCloud& cloud,
                                               const Transform<World, Sensor>& T_world_sensor,
                                               const GroundFrame& ground,
                                               const TrackConfig& config);

}  // namespace mms
