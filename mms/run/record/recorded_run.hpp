#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_record.hpp"

namespace mms {

/// A row of loops.csv.
struct LoopRecord {
  Timestamp earlier;
  Timestamp later;
  std::string outcome;
};

/// Content of a result folder, as far as available.
struct RunFiles {
  Trajectory trajectory;
  MapCloud map;
  ObjectHistory objects;
  Trajectory truth;
  std::map<Timestamp, std::vector<float>> times;  ///< read, stages, interval [ms]
  std::map<Timestamp, FrameRecord> frames;
  std::vector<LoopRecord> loops;
  std::optional<RunRecord> record;
  SystemConfig config;
  std::string data;                   ///< input of the run, if known
  std::vector<std::string> warnings;  ///< of files that are left out as they cannot be read
};

/// Reads the results of mms run, or the journal of a killed run.
/// @throws FileError, DataError if the folder has none, or its poses cannot be read.
RunFiles read_run_files(const std::filesystem::path& folder);

}  // namespace mms
