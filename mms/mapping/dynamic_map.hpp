#pragma once

#include <vector>

#include "mms/core/config.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/mapping/association.hpp"
#include "mms/mapping/track.hpp"

namespace mms {

struct DynamicMapConfig {
  AssociationConfig association{};
  int confirm_after = 3;
  double max_missed = 1.0;       ///< [s]
  double velocity_window = 0.6;  ///< [s]

  void visit(ConfigVisitor& v) {
    v.group({"association", "", "which object continues which track"}, association);
    v.integer({"confirm_after", "", "observations that make a tentative track one"}, confirm_after,
              {1.0, 100.0});
    v.number({"max_missed", "s", "longest time a track goes on unseen"}, max_missed, {0.0, 60.0});
    v.number({"velocity_window", "s", "past over which the velocity is fitted"}, velocity_window,
             {0.0, 60.0});
  }
};

/// The dynamic map (III-D, built from P_D): the frame's dynamic clusters linked over time to tracks
/// with id, class, box, velocity and history in the world frame.
class DynamicMap {
 public:
  explicit DynamicMap(const DynamicMapConfig& config = {}) : config_(config) {}

  /// Adds a frame; every frame, keyframe or not. A frame that is not later than the last one or has
  /// no finite pose changes nothing.
  void update(const LabeledCloud& cloud, const OdometryEstimate& odometry);

  /// All tracks by id, also those that ended; tentative ones that ended are dropped.
  const std::vector<Track>& tracks() const { return tracks_; }

  /// Copies of the tracks that are active or coasting, with the last observation as history.
  std::vector<Track> active() const;

 private:
  void extend(Track& track, const ObjectObservation& object) const;
  void begin(const ObjectObservation& object);
  void age(Timestamp now);

  DynamicMapConfig config_;
  std::vector<Track> tracks_;
  Timestamp last_stamp_{-1};
  int next_id_ = 1;
};

}  // namespace mms
