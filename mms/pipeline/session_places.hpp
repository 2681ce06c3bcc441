#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mms/global_map/global_map.hpp"
#include "mms/global_map/pose_correction.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// Place of a session of a run in the frame of the map.
struct SessionPlace {
  /// Whether it is known. The frame is that of an earlier map if loops join a session of the run to
  /// it, else that of the first session with a keyframe.
  bool is_known = true;
  PoseCorrection correction;  ///< to the frame of the sessions that loops join to it

  /// Pose of a frame of the session in the frame of the map; nothing if that is not known.
  std::optional<Transform<World, Sensor>> corrected(
      Timestamp stamp, const Transform<World, Sensor>& T_world_sensor) const;

  /// The static map of the session, corrected.
  MapCloud corrected(StampedMap map) const;
};

/// A session of the global map whose frame is that of the map for the run, see
/// `SessionPlace::is_known`; nothing without keyframes.
/// @param sessions  of the run, at least 1
std::optional<std::uint32_t> session_of_map_frame(const GlobalMap& map, std::uint32_t sessions);

/// Places of the sessions of a run, by their number.
/// @param sessions  number of them, at least 1
std::vector<SessionPlace> session_places(const GlobalMap& map, std::uint32_t sessions);

/// Whether the frame of the map differs from the world frame for a session.
bool are_corrected(const std::vector<SessionPlace>& places);

/// The static maps of the sessions whose place is known, joined in the frame of the map.
/// @param maps  by session
MapCloud joined_map(const std::vector<StampedMap>& maps, const std::vector<SessionPlace>& places);

}  // namespace mms
