#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <set>

#include "apps/mms/commands/eval/eval_parts.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/run/record/run_record.hpp"

namespace mms {

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print one JSON object instead of a table");
}

Trajectory map_poses(const std::filesystem::path& result) {
  const std::filesystem::path frames = result / "frames.csv";
  std::set<Timestamp> lost;
  if (std::filesystem::exists(frames)) {
    for (const FrameRecord& frame : read_frame_records(frames)) {
      if (frame.status == Status::kLost) lost.insert(frame.stamp);
    }
  }
  return poses_without(read_trajectory_tum(map_trajectory_file(result)), lost);
}

void print_metrics(const std::vector<MetricValue>& values, bool json) {
  if (json) {
    fmt::print("{}\n", to_json(values));
  } else {
    fmt::print("{}", to_table(values));
  }
}

void add_eval_command(CLI::App& app) {
  CLI::App* eval = app.add_subcommand("eval", "Evaluate results against ground truth");
  eval->require_subcommand(1);
  add_eval_trajectory(*eval);
  add_eval_drift(*eval);
  add_eval_map(*eval);
  add_eval_ghost_points(*eval);
  add_eval_segmentation(*eval);
  add_eval_objects(*eval);
}

}  // namespace mms
