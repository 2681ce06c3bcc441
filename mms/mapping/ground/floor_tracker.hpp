#pragma once

#include <optional>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/ground/floor.hpp"

namespace mms {

/// The floor around the sensor, on which tracked objects stand. Searches it every third of a second
/// and averages, so that it is accurate near the sensor though the floor is not exactly a plane.
class FloorTracker {
 public:
  explicit FloorTracker(const FloorConfig& config = {}) : config_(config) {}

  /// Searches the floor among the frame's static points. Frames come in the order of their stamps.
  /// @param up  in the world frame, used until a floor is found
  void update(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor,
              const Eigen::Vector3d& up);

  /// Nothing until one was found.
  const std::optional<Floor>& floor() const { return floor_; }

 private:
  void follow(const Floor& seen, const Eigen::Vector3d& sensor, Timestamp stamp);

  FloorConfig config_;
  std::optional<Floor> floor_;
  std::optional<Timestamp> last_search_;
  Timestamp last_floor_;
  std::optional<Timestamp> rejected_since_;  // while floors are rejected
  int averaged_ = 0;
};

}  // namespace mms
