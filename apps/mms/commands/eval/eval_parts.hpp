#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

// The commands of `mms eval`, one function each. All have --json.
void add_eval_trajectory(CLI::App& eval);
void add_eval_drift(CLI::App& eval);
void add_eval_map(CLI::App& eval);
void add_eval_ghost_points(CLI::App& eval);
void add_eval_segmentation(CLI::App& eval);
void add_eval_objects(CLI::App& eval);

/// Adds the flag --json, which sets `json`.
void add_json_flag(CLI::App& command, bool& json);

/// Poses of a run in the frame of its maps, without those of lost frames.
Trajectory map_poses(const std::filesystem::path& result);

/// Prints a table on stdout, or one JSON object.
void print_metrics(const std::vector<MetricValue>& values, bool json);

}  // namespace mms
