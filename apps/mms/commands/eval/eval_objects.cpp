#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/mms/commands/eval/eval_parts.hpp"
#include "mms/core/error.hpp"
#include "mms/evaluation/tracking/tracking_error.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace {

struct ObjectArguments {
  std::string truth;   ///< simulated recording
  std::string result;  ///< result folder of a run
  bool json = false;
};

void evaluate_objects(const ObjectArguments& arguments) {
  const std::filesystem::path truth = arguments.truth;
  const std::filesystem::path result = arguments.result;
  const ObjectHistory objects = frames_during(read_objects_truth(truth / "objects_truth.json"),
                                              read_trajectory_tum(result / "trajectory.tum"));
  const ObjectHistory tracks = read_objects(result / "objects.json");
  const Trajectory poses = read_trajectory_tum(truth / "groundtruth.txt");
  const auto T = align_truth(poses, map_poses(result));
  if (!T) {
    throw DataError((result / "trajectory.tum").string(),
                    "has no pose within 0.02 s of a ground-truth pose",
                    "expected the result of a run on " + arguments.truth);
  }
  print_metrics(metric_values(evaluate_tracking(objects, transformed(tracks, T->inverse()), poses)),
                arguments.json);
}

}  // namespace

void add_eval_objects(CLI::App& eval) {
  const auto arguments = std::make_shared<ObjectArguments>();
  CLI::App* command = eval.add_subcommand(
      "objects",
      "Compare tracked with ground-truth objects: identities, positions, velocities (3 m to 8 m)");
  command
      ->add_option("TRUTH", arguments->truth,
                   "simulated recording, with objects_truth.json and groundtruth.txt")
      ->required();
  command
      ->add_option("RESULT", arguments->result,
                   "result folder of a run on it, with objects.json and trajectory.tum")
      ->required();
  add_json_flag(*command, arguments->json);
  command->callback([arguments] { evaluate_objects(*arguments); });
}

}  // namespace mms
