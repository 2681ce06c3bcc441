#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include "apps/mms/commands/eval/eval_parts.hpp"

namespace mms {

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print one JSON object instead of a table");
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
