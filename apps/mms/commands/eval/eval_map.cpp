#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/mms/commands/calibration_options.hpp"
#include "apps/mms/commands/eval/eval_parts.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/evaluation/map/ghost_points.hpp"
#include "mms/evaluation/map/map_error.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

struct MapArguments {
  std::string truth;  ///< PLY with labels, or the recording for the ghost points
  std::string map;
  bool no_align = false;
  bool json = false;
  CameraOptions camera;  ///< in place of the recording's
};

PointCloudFile read_finite(const std::string& file) {
  PointCloudFile cloud = read_ply(file);
  const std::size_t invalid = remove_invalid_points(cloud);
  if (invalid > 0) {
    fmt::print(stderr, "warning: {}: {} points are not finite and left out\n", file, invalid);
  }
  return cloud;
}

/// Pose of the truth in the map, as in metrics.json, if the poses of both are beside them.
std::optional<Eigen::Isometry3d> truth_alignment(const MapArguments& arguments) {
  const fs::path truth = fs::path(arguments.truth).parent_path() / "groundtruth.txt";
  const fs::path poses = map_trajectory_file(fs::path(arguments.map).parent_path());
  if (arguments.no_align || !fs::exists(truth) || !fs::exists(poses)) return std::nullopt;
  auto T = align_truth(read_trajectory_tum(truth), map_poses(poses.parent_path()));
  if (!T) {
    print_warnings({fmt::format("{} and {} have no pose in common: the ground truth is not aligned",
                                truth.string(), poses.string())});
  }
  return T;
}

void evaluate_cleanness(const MapArguments& arguments) {
  const PointCloudFile truth = read_finite(arguments.truth);
  if (truth.labels.empty() && !truth.points.empty()) {
    throw DataError(arguments.truth, "has no property 'label'",
                    "expected a label per point: 0 static, else the object's id");
  }
  const auto T = truth_alignment(arguments);
  if (T && !arguments.json) fmt::print("ground truth aligned by the poses beside both files\n");
  const Eigen::Isometry3f T_map_truth = T.value_or(Eigen::Isometry3d::Identity()).cast<float>();
  const MapError error = evaluate_labeled_map(truth.points, truth.labels, T_map_truth,
                                              read_finite(arguments.map).points);
  if (!arguments.json) {
    fmt::print(
        "ground truth: {} static and {} dynamic points; {} dynamic ones within 5 cm of a static "
        "one excluded\n",
        error.static_points, error.dynamic_points, error.ambiguous_points);
  }
  print_metrics(metric_values(error), arguments.json);
}

void evaluate_ghost_points_of(const MapArguments& arguments) {
  const auto source =
      open_dataset(arguments.truth, {.masks = {}, .load_masks = false, .camera = arguments.camera});
  source->on_warning(
      [](const std::string& message) { fmt::print(stderr, "warning: {}\n", message); });
  RoomDepth room;
  std::optional<CameraIntrinsics> camera;
  while (const auto frame = source->next()) {
    if (!frame->has_depth()) {
      throw DataError(arguments.truth, "has no depth images",
                      "ghost points are counted in a camera's view");
    }
    room.add(frame->depth);
    camera = frame->calibration->camera;
  }
  if (!camera) throw DataError(arguments.truth, "has no readable frame");
  const auto map = read_finite(arguments.map).points;
  print_metrics(metric_values(evaluate_ghost_points(map, room.far_mode(), *camera)),
                arguments.json);
}

}  // namespace

void add_eval_map(CLI::App& eval) {
  const auto arguments = std::make_shared<MapArguments>();
  CLI::App* command = eval.add_subcommand("map", "Accuracy SA, DA, AA, HA of a static map (5 cm)");
  command
      ->add_option("TRUTH", arguments->truth,
                   "PLY with a label per point: 0 static, else the object's id")
      ->required();
  command
      ->add_option("MAP", arguments->map,
                   "PLY in the same world frame, or aligned by poses beside both")
      ->required();
  command->add_flag("--no-align", arguments->no_align,
                    "compare as they are, without groundtruth.txt and trajectory of a run");
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { evaluate_cleanness(*arguments); });
}

namespace {

void add_ghost_points(CLI::App& command, bool is_former_name) {
  const auto arguments = std::make_shared<MapArguments>();
  command.add_option("DATA", arguments->truth, "recording of a static camera")->required();
  command.add_option("MAP", arguments->map, "PLY of its static map")->required();
  add_json_flag(command, arguments->json);
  add_calibration_options(command, arguments->camera);
  command.callback([arguments, is_former_name] {
    if (is_former_name) print_warnings({"mms eval residue is now called mms eval ghost-points"});
    evaluate_ghost_points_of(*arguments);
  });
}

}  // namespace

void add_eval_ghost_points(CLI::App& eval) {
  add_ghost_points(
      *eval.add_subcommand(
          "ghost-points",
          "Count points of people and vehicles in a static map, in the view of a static camera"),
      false);
  add_ghost_points(*eval.add_subcommand("residue", "Former name of ghost-points")->group(""), true);
}

}  // namespace mms
