#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/mms/commands/eval/eval_parts.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/lidar/kitti_calibration.hpp"
#include "mms/evaluation/trajectory/drift.hpp"
#include "mms/evaluation/trajectory/kitti_drift.hpp"
#include "mms/evaluation/trajectory/trajectory_error.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace {

struct TrajectoryArguments {
  std::string reference;
  std::string estimate;
  double max_difference = 0.02;  ///< [s]
  std::optional<double> rpe_delta;
  std::string rpe_unit = "s";
  std::string kitti_calib;  ///< ESTIMATE is of this calibration's LiDAR, REFERENCE of its camera 0
  bool no_align = false;
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

Matching matching_of(const TrajectoryArguments& arguments) {
  const bool by_index = is_kitti_trajectory(arguments.reference);
  if (by_index != is_kitti_trajectory(arguments.estimate)) {
    throw DataError(
        arguments.estimate,
        "has another format than " + arguments.reference +
            ": one has stamps (TUM, 8 numbers per line), the other has none (KITTI, 12)",
        "mms run writes both formats: trajectory.tum and trajectory_kitti.txt");
  }
  return by_index ? Matching::kByIndex : Matching::kByStamp;
}

TrajectoryErrorOptions options_of(const TrajectoryArguments& arguments) {
  TrajectoryErrorOptions options;
  options.matching = matching_of(arguments);
  options.align = !arguments.no_align;
  options.max_difference =
      std::chrono::round<Duration>(std::chrono::duration<double>(arguments.max_difference));
  if (arguments.rpe_delta) {
    options.rpe_delta = {*arguments.rpe_delta, kUnits.at(arguments.rpe_unit)};
  }
  return options;
}

/// Poses of the LiDAR as poses of camera 0, both in the frame of the first one.
Trajectory poses_of_camera(Trajectory poses, const Eigen::Isometry3d& T_camera_lidar) {
  for (StampedPose& pose : poses) {
    pose.T_world_sensor = Transform<World, Sensor>(T_camera_lidar * pose.T_world_sensor.isometry() *
                                                   T_camera_lidar.inverse());
  }
  return poses;
}

void warn_of_lengths(const TrajectoryArguments& arguments, std::size_t reference,
                     std::size_t estimate) {
  if (reference == estimate) return;
  print_warnings({fmt::format(
      "{} has {} poses, {} has {}: matched frame by frame, they only fit if the last ones are "
      "missing; files of TUM's format are matched by stamps",
      arguments.reference, reference, arguments.estimate, estimate)});
}

void evaluate(const TrajectoryArguments& arguments) {
  const TrajectoryErrorOptions options = options_of(arguments);
  const Trajectory reference = read_trajectory(arguments.reference);
  Trajectory estimate = read_trajectory(arguments.estimate);
  if (options.matching == Matching::kByIndex) {
    warn_of_lengths(arguments, reference.size(), estimate.size());
  }
  if (!arguments.kitti_calib.empty()) {
    estimate = poses_of_camera(estimate,
                               read_kitti_calibration(arguments.kitti_calib, {}).T_camera0_lidar);
  }
  const TrajectoryError error = evaluate_trajectory(reference, estimate, options);
  if (error.rpe.axes_differ) {
    print_warnings({fmt::format(
        "{} moves along other axes than {}: they seem to be poses of different sensors, so that "
        "RPE and KITTI drift have no meaning; --kitti-calib converts poses of KITTI's LiDAR",
        arguments.estimate, arguments.reference)});
  }
  if (!arguments.json) {
    const RelativeDelta delta = rpe_delta(options);
    const std::string how = options.matching == Matching::kByIndex
                                ? "frame by frame"
                                : fmt::format("within {} s", arguments.max_difference);
    fmt::print("matched {} of {} poses {}, {}; RPE over {} pairs {} {} apart\n", error.matched,
               error.poses, how, options.align ? "SE(3) aligned" : "not aligned", error.rpe.pairs,
               delta.value, unit_name(delta.unit));
  }
  std::vector<MetricValue> values = metric_values(error);
  if (options.matching == Matching::kByIndex) {
    const std::vector<MetricValue> drift =
        metric_values(kitti_drift(reference, estimate, match_by_index(reference, estimate)));
    values.insert(values.end(), drift.begin(), drift.end());
  }
  print_metrics(values, arguments.json);
}

void add_options(CLI::App& command, TrajectoryArguments& arguments) {
  command
      .add_option(
          "--max-difference", arguments.max_difference,
          "largest difference of matched stamps [s]; KITTI files are matched frame by frame")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  CLI::Option* delta =
      command
          .add_option(
              "--rpe-delta", arguments.rpe_delta,
              "distance between the poses of an RPE pair (default: 1 s; KITTI files: 10 m of path)")
          ->check(CLI::Range(1e-9, 1e9));
  command.add_option("--rpe-unit", arguments.rpe_unit, "unit of --rpe-delta")
      ->check(CLI::IsMember({"s", "m", "frames"}))
      ->needs(delta);
  command.add_option("--kitti-calib", arguments.kitti_calib,
                     "calib.txt of a KITTI sequence: ESTIMATE has poses of its LiDAR, REFERENCE of "
                     "its camera 0");
  command.add_flag("--no-align", arguments.no_align,
                   "compare in the frame of REFERENCE, as after localization in a known map");
}

}  // namespace

void add_eval_trajectory(CLI::App& eval) {
  const auto arguments = std::make_shared<TrajectoryArguments>();
  CLI::App* command = eval.add_subcommand("trajectory", "ATE and RPE against a reference");
  command->add_option("REFERENCE", arguments->reference, "ground truth, a TUM, EuRoC or KITTI file")
      ->required();
  command->add_option("ESTIMATE", arguments->estimate, "trajectory, a file of the same format")
      ->required();
  add_options(*command, *arguments);
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { evaluate(*arguments); });
}

void add_eval_drift(CLI::App& eval) {
  const auto arguments = std::make_shared<TrajectoryArguments>();
  CLI::App* command = eval.add_subcommand("drift", "ATDE and MTDE of a static sensor");
  command->add_option("ESTIMATE", arguments->estimate, "trajectory, a TUM or KITTI file")
      ->required();
  add_json_flag(*command, arguments->json);
  command->callback([arguments] {
    print_metrics(metric_values(evaluate_drift(read_trajectory(arguments->estimate))),
                  arguments->json);
  });
}

}  // namespace mms
