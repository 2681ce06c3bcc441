#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/object_box.hpp"
#include "mms/core/trajectory.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/run/record/run_record.hpp"

namespace mms {

/// What a result folder holds, as far as it is there.
struct RunFiles {
  Trajectory trajectory;
  MapCloud map;
  ObjectHistory objects;
  Trajectory truth;
  std::map<Timestamp, std::vector<float>> times;  ///< milliseconds of read and the stages
  std::map<Timestamp, FrameRecord> frames;
  std::optional<RunRecord> record;
  SystemConfig config;
  std::string data;  ///< what was run, where that is known
};

/// Reads what mms run wrote, or the journal of a run that was killed.
/// @throws FileError, DataError when it is no such folder or a file in it cannot be read.
RunFiles read_run_files(const std::filesystem::path& folder);

}  // namespace mms
