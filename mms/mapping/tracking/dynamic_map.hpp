#pragma once

#include <optional>
#include <vector>

#include "mms/core/config_visitor.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/object_box.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/mapping/ground/floor_tracker.hpp"
#include "mms/mapping/tracking/association.hpp"
#include "mms/mapping/tracking/track.hpp"
#include "mms/mapping/tracking/track_reidentifier.hpp"

namespace mms {

struct DynamicMapConfig {
  AssociationConfig association;
  TrackConfig track;
  int confirm_after = 4;           ///< [-]: a count of detections, not a time: each is evidence
  int confirm_unknown_after = 10;  ///< [-]: more, since an error of the pose resembles motion
  double max_missed = 1.5;         ///< [s]
  double max_tentative = 1.0;      ///< [s]
  double max_coast_output = 0.5;   ///< [s]
  double history_lag = 1.0;        ///< [s]
  ReidentificationConfig reidentification;

  void visit(ConfigVisitor& v) {
    v.group({"association", "", "which object continues which track"}, association);
    v.group({"track", "", "how objects move and are measured"}, track);
    v.integer({"confirm_after", "", "observations that confirm a tentative track"}, confirm_after,
              {1.0, 100.0});
    v.integer({"confirm_unknown_after", "", "the same for moving objects without a mask"},
              confirm_unknown_after, {1.0, 1000.0});
    v.number({"max_missed", "s", "longest time a track continues unseen"}, max_missed, {0.0, 60.0});
    v.number({"max_tentative", "s", "the same for a tentative one, unseen by the network"},
             max_tentative, {0.0, 60.0});
    v.number({"max_coast_output", "s", "longest time an unseen object is reported", "max_shown"},
             max_coast_output, {0.0, 60.0});
    v.number({"history_lag", "s",
              "delay of the smoothed motions in objects.json; 0: the filter's own estimates"},
             history_lag, {0.0, 60.0});
    v.group({"reidentification", "", "objects that come back after they were lost", "returning"},
            reidentification);
  }
};

/// An object of the dynamic map at the last frame.
struct TrackedObject {
  ObjectBox box;
  TrackState state = TrackState::kActive;
  MotionFilter motion;  ///< of the box's center, with its covariance
  Timestamp first_seen;
  Timestamp last_seen;
};

/// The dynamic map (III-D, built from P_D): the frame's dynamic clusters linked over time to
/// objects with id, class, box and velocity in the world frame. Holds the present objects only:
/// its size and cost do not grow with the length of a run.
class DynamicMap {
 public:
  /// @param floor  how the floor below the objects is found
  explicit DynamicMap(const DynamicMapConfig& config = {}, const FloorConfig& floor = {})
      : config_(config), floor_tracker_(floor), lost_(config.reidentification) {}

  /// Adds a frame, keyframe or not. A frame that is not later than the last one or has no finite
  /// pose changes nothing.
  void update(const LabeledCloud& cloud, const OdometryEstimate& odometry);

  /// The objects by id: confirmed ones, seen in the last frame or not much earlier.
  std::vector<TrackedObject> objects() const;

  /// Objects confirmed since the beginning.
  int confirmed() const { return confirmed_; }

 private:
  void update_ground(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);
  void extend(const std::vector<ObjectMeasurement>& objects, const std::vector<int>& track_of);
  void begin_new(const std::vector<ObjectMeasurement>& objects, const std::vector<int>& track_of);
  bool is_part_of_a_track(const ObjectMeasurement& object) const;
  bool is_shared(const ObjectMeasurement& object, const std::vector<bool>& has_own) const;
  void confirm_seen();
  bool is_sure(const Track& track) const;
  std::optional<Track> reidentify(const Track& track, const std::vector<int>& back);
  void prune();
  bool is_over(const Track& track) const;

  DynamicMapConfig config_;
  FloorTracker floor_tracker_;
  std::optional<GroundFrame> ground_;
  std::vector<Track> tracks_;
  TrackReidentifier lost_;
  Timestamp last_stamp_{-1};
  int next_id_ = 1;
  int confirmed_ = 0;
};

}  // namespace mms
