#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Which ground-truth objects count, and the matching distance.
struct TrackingOptions {
  double min_range = 3.0;       ///< of the object's center from the sensor [m]
  double max_range = 8.0;       ///< [m]
  double min_visible = 0.2;     ///< visible share of the object
  double match_distance = 1.0;  ///< between box centers [m]
};

/// Accuracy of tracked objects. NaN if undefined.
struct TrackingError {
  std::int64_t objects = 0;  ///< ground-truth boxes that count, summed over the frames
  double idf1 = 0.0;         ///< for the best one-to-one pairing of ids over all frames, in [0, 1]
  double recall = 0.0;       ///< share of the ground-truth boxes with a tracked one
  double false_discovery_rate = 0.0;      ///< share of the tracked boxes that are false positives
  std::int64_t id_switches = 0;           ///< changes of the track id of a ground-truth object
  double center_mean = 0.0;               ///< between centers of paired boxes [m]
  double center_median = 0.0;             ///< [m]
  double velocity_rmse = 0.0;             ///< [m/s]
  std::int64_t motion_state_changes = 0;  ///< visible starts and stops
  double motion_state_delay_max = 0.0;    ///< until a start or stop is recognized [s]
};

/// Compares frame by frame (equal stamps). Boxes are paired with the least sum of distances; pairs
/// of the previous frame are kept while possible (as in CLEAR MOT, Bernardin and Stiefelhagen
/// 2008). IDF1 as in Ristani et al. 2016. Objects out of range or view need not be tracked, and
/// tracked boxes on them or out of range are ignored. Starts and stops count if the object stays in
/// view until they are recognized, or for a second. The end of the recording ends the view.
/// @param truth    in the world frame of `sensor`
/// @param tracks   in the same frame
/// @param sensor   ground-truth poses with the stamps of the frames
TrackingError evaluate_tracking(const ObjectHistory& truth, const ObjectHistory& tracks,
                                const Trajectory& sensor, const TrackingOptions& options = {});

/// The frames from the first to the last pose of a run, which may have played a part of the
/// recording only. Frames between them that it has dropped remain.
ObjectHistory frames_during(ObjectHistory history, const Trajectory& poses);

std::vector<MetricValue> metric_values(const TrackingError& error);

/// Transforms boxes and velocities to another frame.
ObjectHistory transformed(ObjectHistory history, const Eigen::Isometry3d& T_to_from);

}  // namespace mms
