#pragma once

#include <filesystem>
#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// What a run's journal gives back.
struct RecoveredRun {
  JournalHeader header;
  Trajectory trajectory;
  Trajectory keyframes;
  MapCloud map;
  Timestamp written;      ///< wall clock of the last frame, since 1970
  bool organised = true;  ///< from a depth camera (y down), else a LiDAR (z up)
  std::string damage;     ///< why the journal was not read to its end; empty where it was
};

/// Reads a journal up to its first record that is not whole.
/// @throws FileError when it cannot be read; DataError when it is no journal or holds no frame.
RecoveredRun recover_run(const std::filesystem::path& journal);

}  // namespace mms
