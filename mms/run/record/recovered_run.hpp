#pragma once

#include <filesystem>
#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// Content of a run's journal.
struct RecoveredRun {
  JournalHeader header;
  Trajectory trajectory;
  Trajectory keyframes;
  MapCloud map;           ///< of all sessions, as they were localized
  Timestamp written;      ///< wall clock of the last frame, since 1970
  bool organised = true;  ///< true for a depth camera (y down), false for a LiDAR (z up)
  std::string damage;     ///< fault at which reading stopped; empty if the journal is complete
};

/// Reads a journal up to its first incomplete record.
/// @throws FileError if it cannot be read; DataError if it is not a journal or has no frame.
RecoveredRun recover_run(const std::filesystem::path& journal);

}  // namespace mms
