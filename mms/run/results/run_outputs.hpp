#pragma once

#include <filesystem>
#include <string>

#include "mms/pipeline/slam_system.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_log.hpp"

namespace mms {

/// Writes a run's files to `folder`: trajectory.tum, trajectory_kitti.txt, keyframes.tum,
/// static_map.ply, static_map.pcd, semantic_map.ply, map.pgm, map.yaml, map.bt, objects.json,
/// config.yaml, metrics.json, timing.csv, report.html, and its images as PNG files in pictures/;
/// where they exist, trajectory_map.tum and loops.csv, and the maps of sessions that have no place
/// in the map, in outside_map/.
/// @param data      input of the run, for the report's title
/// @param warnings  of the run, for the report
/// @throws FileError with the file that cannot be written.
void write_outputs(const std::filesystem::path& folder, const std::string& data,
                   const SystemConfig& config, const SlamSystem& system, const RunLog& log,
                   const std::vector<std::string>& warnings);

}  // namespace mms
