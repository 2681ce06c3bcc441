#pragma once

#include <optional>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/ground/floor.hpp"

namespace mms {

/// The floor about the sensor, as the frames of a run show it: what stands on it is measured from
/// there. Looks at every few frames, and averages, so that a floor that is not quite level far away
/// is right where the sensor is.
class FloorTracker {
 public:
  explicit FloorTracker(const FloorConfig& config = {}) : config_(config) {}

  /// Looks for the floor among the frame's static points.
  /// @param up  in the world frame, as far as it is known without a floor
  void update(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor,
              const Eigen::Vector3d& up);

  /// Nothing until one was seen.
  const std::optional<Floor>& floor() const { return floor_; }

 private:
  void follow(const Floor& seen, const Eigen::Vector3d& sensor);

  FloorConfig config_;
  std::optional<Floor> floor_;
  int frames_ = 0;
  int seen_ = 0;      // floors averaged
  int rejected_ = 0;  // in a row
};

}  // namespace mms
