#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/voxels/map_changes.hpp"

namespace mms {

/// The name of a run's journal in its result folder.
inline constexpr std::string_view kJournalName = "journal.bin";

/// What a journal begins with: what is needed to make a map of its changes.
struct JournalHeader {
  std::string data;          ///< what was run, in the user's words
  double voxel_size = 0.0;   ///< of the first keyframe's map [m]
  int min_observations = 1;  ///< views that have to see a voxel before it is shown
};

/// A frame of a run, as the journal keeps it. At the end of a run the last one is there a second
/// time if it was no keyframe, with what the frames since the last keyframe did to the map.
struct JournalFrame {
  Timestamp stamp;                          ///< of the frame
  Timestamp written;                        ///< wall clock when the frame was done, since 1970
  Transform<World, Sensor> T_world_sensor;  ///< estimated pose
  Status status = Status::kInitialized;     ///< of the pose
  bool keyframe = false;                    ///< whether it was integrated into the static map
  bool organised = false;                   ///< of a depth camera (y down), else a LiDAR (z up)
  std::optional<MapChanges> map;            ///< what was done to the static map since the last one
};

/// The bytes of a journal (docs/journal.md): a header, then a record a frame.
/// @throws DataError when the text or the map is too large for a record.
std::string encode_header(const JournalHeader& header);
std::string encode_frame(const JournalFrame& frame);

/// What a record's payload holds; the inverse of the above.
/// @param where  for messages
/// @throws DataError for anything that no writer writes.
JournalHeader decode_header(std::string_view payload, const std::string& where);
JournalFrame decode_frame(std::string_view payload, const std::string& where);

}  // namespace mms
