#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Which true objects have to be found, and what counts as found.
struct TrackingOptions {
  double min_range = 3.0;       ///< of the object's center from the sensor [m]
  double max_range = 8.0;       ///< [m]
  double min_visible = 0.2;     ///< share of the object in view
  double match_distance = 1.0;  ///< between the centers of boxes [m]
};

/// How well tracked objects follow the true ones. NaN where nothing of the kind happened.
struct TrackingError {
  std::int64_t objects = 0;  ///< true boxes to be found, summed over the frames
  double idf1 = 0.0;         ///< of the best one-to-one pairing of ids over all frames, in [0, 1]
  double recall = 0.0;       ///< share of the true boxes with a tracked one
  double false_discovery_rate = 0.0;      ///< share of the tracked boxes that are false positives
  std::int64_t id_switches = 0;           ///< times that the id on a true object became another
  double center_mean = 0.0;               ///< between centers of paired boxes [m]
  double center_median = 0.0;             ///< [m]
  double velocity_rmse = 0.0;             ///< [m/s]
  std::int64_t motion_state_changes = 0;  ///< starts and stops seen
  double motion_state_delay_max = 0.0;    ///< until a start or stop was recognised [s]
};

/// Compares frame by frame (equal stamps). In a frame boxes are paired so that the distances add up
/// to the least; a pair of the frame before holds as long as it can (as in CLEAR MOT, Bernardin and
/// Stiefelhagen 2008). IDF1 is that of Ristani et al. 2016. True objects out of range or out of
/// view need not be found, and tracked boxes on them or out of range do no harm. Starts and stops
/// count where the object stays in view until they are recognised, or for a second.
/// @param truth    in the world frame of `sensor`
/// @param tracks   in the same frame
/// @param sensor   true poses with the stamps of the frames
TrackingError evaluate_tracking(const ObjectHistory& truth, const ObjectHistory& tracks,
                                const Trajectory& sensor, const TrackingOptions& options = {});

std::vector<MetricValue> metric_values(const TrackingError& error);

/// Moves boxes and their velocities to another frame.
ObjectHistory transformed(ObjectHistory history, const Eigen::Isometry3d& T_to_from);

}  // namespace mms
