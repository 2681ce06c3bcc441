#pragma once

#include <optional>
#include <vector>

#include "mms/core/thread_confinement.hpp"
#include "mms/geometry/voxels/map_changes.hpp"
#include "mms/mapping/occupancy/occupancy_map.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "mms/mapping/tracking/dynamic_map.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// The stage after the pose (III-C.4, III-D). Owns the static map, the occupancy map and the
/// tracked objects.
class Mapping {
 public:
  explicit Mapping(const SystemConfig& config);

  /// Tracks the frame's dynamic objects and integrates its points into the maps. One thread at a
  /// time, frames in order; the maps may be read in that thread.
  /// @returns the result with objects
  FrameResult map(FrameResult localized);

  /// Completes the static map after the last frame.
  /// @returns the changes by the frames since the last keyframe; none without such frames
  std::optional<MapChanges> finalize();

  // Of the present session:
  const StaticMap& static_map() const;
  const OccupancyMap& occupancy_map() const;

  /// Changes of the static map by the last keyframe, see `StaticMap`; those by the first one of a
  /// session replace the map.
  MapChanges changes() const;

  /// Static maps of the run's sessions so far, each in its world.
  std::vector<StampedMap> session_maps() const;

  const DynamicMap& dynamic_map() const;

  void release_thread() { thread_.release(); }  ///< lets another thread call

 private:
  void begin_session();
  void clear_maps();

  SystemConfig config_;
  std::vector<StampedMap> earlier_maps_;  // of the sessions before, by their number
  StaticMap static_map_;
  OccupancyMap occupancy_map_;
  DynamicMap dynamic_map_;
  bool is_cleared_ = false;  ///< the maps, at least once
  ThreadConfinement thread_;
};

}  // namespace mms
