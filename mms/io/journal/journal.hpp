#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/map_changes.hpp"

namespace mms {

/// File name of a run's journal in its result folder.
inline constexpr std::string_view kJournalName = "journal.bin";

/// Header of a journal: the parameters needed to build a map of its changes.
struct JournalHeader {
  std::string data;          ///< input of the run, as the user gave it
  double voxel_size = 0.0;   ///< of the map [m]
  int min_observations = 1;  ///< observations that a voxel needs to be part of the map
};

/// A frame of a run in the journal. If the last frame of a run is not a keyframe, it is repeated at
/// the end with the changes of the map since the last keyframe.
struct JournalFrame {
  Timestamp stamp;    ///< of the frame
  Timestamp written;  ///< wall clock after the frame was processed, since 1970
  Transform<World, Sensor> T_world_sensor;  ///< estimated pose
  Status status = Status::kInitialized;     ///< of the pose
  bool keyframe = false;                    ///< whether it was integrated into the static map
  bool organised = false;         ///< true for a depth camera (y down), false for a LiDAR (z up)
  std::optional<MapChanges> map;  ///< changes of the static map since the previous one
};

/// Encodes a header or a frame (docs/formats.md).
/// @throws DataError if the text or the map is too large for a record.
std::string encode_header(const JournalHeader& header);
std::string encode_frame(const JournalFrame& frame);

/// Decodes the payload of a record; inverse of the above.
/// @param where  for messages
/// @throws DataError for invalid content.
JournalHeader decode_header(std::string_view payload, const std::string& where);
JournalFrame decode_frame(std::string_view payload, const std::string& where);

}  // namespace mms
