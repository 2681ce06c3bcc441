#include "eval_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/evaluation/drift.hpp"
#include "mms/evaluation/map_error.hpp"
#include "mms/evaluation/map_residue.hpp"
#include "mms/evaluation/trajectory_error.hpp"
#include "mms/io/ply_io.hpp"
#include "mms/io/text_table.hpp"
#include "mms/io/trajectory_io.hpp"

namespace mms {
namespace {

/// What the command line holds; one struct for the three, each uses its part.
struct Arguments {
  std::string reference;
  std::string estimate;
  double max_difference = 0.02;  // [s]
  std::optional<double> rpe_delta;
  std::string rpe_unit = "s";
  bool json = false;
};

const std::map<std::string, DeltaUnit> kUnits = {
    {"s", DeltaUnit::kSeconds}, {"m", DeltaUnit::kMeters}, {"frames", DeltaUnit::kFrames}};

std::string unit_name(DeltaUnit unit) {
  for (const auto& [name, value] : kUnits) {
    if (value == unit) return name;
  }
  return "";
}

/// KITTI's pose files have 12 numbers a line and no stamps.
bool is_kitti(const std::string& path) {
  constexpr std::size_t kMatrixNumbers = 12;
  const TextTable table(path);
  return !table.lines().empty() && table.lines().front().fields.size() == kMatrixNumbers;
}

Matching matching_of(const Arguments& arguments) {
  const bool by_index = is_kitti(arguments.reference);
  if (by_index != is_kitti(arguments.estimate)) {
    throw DataError(arguments.estimate,
                    "is of another form than " + arguments.reference +
                        ": one has stamps (TUM, 8 numbers a line), the other has none (KITTI, 12)",
                    "mms run writes both forms: trajectory.tum and trajectory_kitti.txt");
  }
  return by_index ? Matching::kByIndex : Matching::kByStamp;
}

void print(const std::vector<MetricValue>& values, bool json) {
  if (json) {
    fmt::print("{}\n", to_json(values));
  } else {
    fmt::print("{}", to_table(values));
  }
}

void evaluate_trajectory_files(const Arguments& arguments) {
  TrajectoryErrorOptions options;
  options.matching = matching_of(arguments);
  options.max_difference =
      std::chrono::round<Duration>(std::chrono::duration<double>(arguments.max_difference));
  if (arguments.rpe_delta)
    options.rpe_delta = {*arguments.rpe_delta, kUnits.at(arguments.rpe_unit)};
  const TrajectoryError error = evaluate_trajectory(read_trajectory(arguments.reference),
                                                    read_trajectory(arguments.estimate), options);
  if (!arguments.json) {
    const RelativeDelta delta = rpe_delta(options);
    const std::string how = options.matching == Matching::kByIndex
                                ? "frame by frame"
                                : fmt::format("within {} s", arguments.max_difference);
    fmt::print("matched {} of {} poses {}, SE(3) aligned; RPE over {} pairs {} {} apart\n",
               error.matched, error.poses, how, error.rpe.pairs, delta.value,
               unit_name(delta.unit));
  }
  print(metric_values(error), arguments.json);
}

void evaluate_map_files(const Arguments& arguments) {
  const PointCloudFile truth = read_ply(arguments.reference);
  if (truth.labels.empty() && !truth.points.empty()) {
    throw DataError(arguments.reference, "has no property 'label'",
                    "a truth map labels its points: 0 static, else the object's id");
  }
  std::vector<Eigen::Vector3f> fixed;
  std::vector<Eigen::Vector3f> dynamic;
  for (std::size_t i = 0; i < truth.points.size(); ++i) {
    (truth.labels[i] == 0 ? fixed : dynamic).push_back(truth.points[i]);
  }
  const MapError error = evaluate_map(fixed, dynamic, read_ply(arguments.estimate).points);
  if (!arguments.json) {
    fmt::print(
        "truth: {} static and {} dynamic points; {} dynamic ones within 5 cm of a static "
        "one left out\n",
        error.static_points, error.dynamic_points, error.ambiguous_points);
  }
  print(metric_values(error), arguments.json);
}

void evaluate_residue_of(const Arguments& arguments) {
  const auto source = open_dataset(arguments.reference, {.masks = {}, .load_masks = false});
  RoomDepth room;
  std::optional<CameraIntrinsics> camera;
  while (const auto frame = source->next()) {
    if (!frame->has_depth()) {
      throw DataError(arguments.reference, "has no depth images",
                      "the residue is seen by a camera");
    }
    room.add(frame->depth);
    camera = frame->calibration->camera;
  }
  if (!camera) throw DataError(arguments.reference, "has no readable frame");
  const auto map = read_ply(arguments.estimate).points;
  print(metric_values(evaluate_residue(map, room.far_mode(), *camera)), arguments.json);
}

/// A subcommand whose arguments live as long as its callback.
CLI::App* add_command(CLI::App& parent, const std::string& name, const std::string& description,
                      const std::shared_ptr<Arguments>& arguments, void (*run)(const Arguments&)) {
  CLI::App* command = parent.add_subcommand(name, description);
  command->add_flag("--json", arguments->json, "print one JSON object in place of a table");
  command->callback([arguments, run] { run(*arguments); });
  return command;
}

void add_trajectory_command(CLI::App& eval) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(eval, "trajectory", "ATE and RPE against a reference", arguments,
                                  evaluate_trajectory_files);
  command->add_option("REFERENCE", arguments->reference, "truth, a TUM or KITTI file")->required();
  command->add_option("ESTIMATE", arguments->estimate, "trajectory, a file of the same form")
      ->required();
  command
      ->add_option(
          "--max-difference", arguments->max_difference,
          "largest difference of matched stamps [s]; KITTI files are matched frame by frame")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  CLI::Option* delta = command
                           ->add_option("--rpe-delta", arguments->rpe_delta,
                                        "how far apart the poses of an RPE pair are (default: 1 s; "
                                        "KITTI files: 10 m of path)")
                           ->check(CLI::Range(1e-9, 1e9));
  command->add_option("--rpe-unit", arguments->rpe_unit, "unit of --rpe-delta")
      ->check(CLI::IsMember({"s", "m", "frames"}))
      ->needs(delta);
}

void add_drift_command(CLI::App& eval) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(eval, "drift", "ATDE and MTDE of a sensor that stood still", arguments,
                  [](const Arguments& a) {
                    print(metric_values(evaluate_drift(read_trajectory(a.estimate))), a.json);
                  });
  command->add_option("ESTIMATE", arguments->estimate, "trajectory, a TUM or KITTI file")
      ->required();
}

void add_map_command(CLI::App& eval) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(eval, "map", "Cleanness SA, DA, AA, HA of a static map (5 cm)",
                                  arguments, evaluate_map_files);
  command
      ->add_option("TRUTH", arguments->reference,
                   "PLY whose points have a label: 0 static, else the id of an object")
      ->required();
  command->add_option("MAP", arguments->estimate, "PLY in the same world frame")->required();
}

void add_residue_command(CLI::App& eval) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(
      eval, "residue", "What moving things left in a map, seen by a camera that stood still",
      arguments, evaluate_residue_of);
  command->add_option("DATA", arguments->reference, "recording of the camera that stood still")
      ->required();
  command->add_option("MAP", arguments->estimate, "PLY of its static map")->required();
}

}  // namespace

void add_eval_command(CLI::App& app) {
  CLI::App* eval = app.add_subcommand("eval", "Measure results against truth");
  eval->require_subcommand(1);
  add_trajectory_command(*eval);
  add_drift_command(*eval);
  add_map_command(*eval);
  add_residue_command(*eval);
}

}  // namespace mms
