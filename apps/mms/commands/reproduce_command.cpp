#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/progress.hpp"
#include "apps/mms/console/warnings.hpp"
#include "apps/mms/paper/paper_tables.hpp"
#include "apps/mms/paper/reproduction.hpp"
#include "mms/core/error.hpp"
#include "mms/evaluation/trajectory/truth_frame.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/run/results/result_folder.hpp"
#include "mms/run/slam_run.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

struct ReproduceOptions {
  std::string still = "sim:still_walker";
  std::string trajectory = "sim:warehouse_loop";
  fs::path output;
  bool overwrite = false;
  fs::path trainings;
  std::string segmenter = "network";
  std::size_t frames = std::numeric_limits<std::size_t>::max();
  int threads = 0;
};

/// One row of the paper's comparison.
struct Method {
  std::string name;
  std::string folder;
  std::string fusion;
};
const Method kWithout{"without semantics", "none", "none"};
const Method kVision{"vision-based", "vision", "vision"};
const Method kMultimodal{"multi-modal", "multimodal", "multimodal"};

/// Plays the recordings and collects the data for the report; each run has a separate folder.
class Reproducer {
 public:
  Reproducer(const ReproduceOptions& options, const fs::path& folder)
      : options_(options), folder_(folder) {
    found_.title = "MMS-SLAM: the paper's tables and figures";
  }

  Reproduction run() {
    if (!options_.trainings.empty()) {
      found_.tables.push_back(segmentation_table(options_.trainings));
    }
    compare_drifts();
    compare_localization();
    return std::move(found_);
  }

 private:
  /// @return the run's results
  PaperRun play(const std::string& data, const std::string& place, const Method& method) {
    RunOptions words;
    words.data = data;
    words.segmenter = method.fusion == "none" ? "none" : options_.segmenter;
    words.fusion = method.fusion;
    words.frames = options_.frames;
    words.threads = options_.threads;
    fmt::print("{}, {}\n", data, method.name);
    const fs::path folder = folder_ / (place + "_" + method.folder);
    make_folder(folder);
    SlamRun run(words);
    Progress progress;
    run.play(folder, progress);
    run.write(folder);
    if (run.interrupted()) throw Error(data, "was interrupted", "the tables require all runs");
    last_trajectory_ = run.log().trajectory();
    last_truth_ = run.log().truth();
    found_.up = run.log().has_image() ? UpAxis::kNegativeY : UpAxis::kPositiveZ;
    return {method.name, run.log().metrics()};
  }

  void compare_drifts() {
    std::vector<PaperRun> runs;
    for (const Method& method : {kWithout, kVision, kMultimodal}) {
      runs.push_back(play(options_.still, "still", method));
      if (!runs.back().metrics.drift) runs.back().metrics.drift = evaluate_drift(last_trajectory_);
    }
    found_.tables.push_back(drift_table(options_.still, runs));
    found_.tables.push_back(stage_table(runs));
  }

  void compare_localization() {
    std::vector<PaperRun> runs;
    for (const Method& method : {kWithout, kMultimodal}) {
      runs.push_back(play(options_.trajectory, "loop", method));
      add_path(method.name);
    }
    for (NamedPath& path : found_.paths) {
      for (StampedPose& pose : path.poses) {
        pose.T_world_sensor = T_world_truth_ * pose.T_world_sensor;
      }
    }
    found_.tables.push_back(localization_table(options_.trajectory, runs));
    add_picture("The static map", "map.png");
    add_picture("The semantic map: people red, vehicles green", "objects.png");
  }

  /// Adds the last run's trajectory in the frame of the ground truth; before the first one, the
  /// ground truth.
  void add_path(const std::string& name) {
    const auto T = align_truth(last_truth_, last_trajectory_);
    if (!T) return;
    if (found_.paths.empty()) found_.paths.push_back({"truth", last_truth_});
    const Transform<World, World> T_truth_map(T->inverse());
    for (StampedPose& pose : last_trajectory_) {
      pose.T_world_sensor = T_truth_map * pose.T_world_sensor;
    }
    found_.paths.push_back({name, last_trajectory_});
    T_world_truth_ = Transform<World, World>(*T);
  }

  void add_picture(const std::string& title, const std::string& file) {
    const fs::path path = folder_ / "loop_multimodal" / "pictures" / file;
    if (fs::exists(path)) found_.pictures.push_back({title, read_color(path)});
  }

  const ReproduceOptions& options_;
  fs::path folder_;
  Reproduction found_;
  Trajectory last_trajectory_;
  Trajectory last_truth_;
  Transform<World, World> T_world_truth_;  ///< of the last run: the axes of its world are known
};

void reproduce(const ReproduceOptions& options) {
  const ResultFolder folder(options.output, "reproduction", options.overwrite);
  const Reproduction found = Reproducer(options, folder.path()).run();
  write_file(folder.path() / "report.html", reproduction_html(found));
  write_file(folder.path() / "reproduction.json", reproduction_json(found));
  folder.make_latest();
  for (const PlainTable& table : found.tables) fmt::print("\n{}", text_of(table));
  fmt::print("\nreport: {}\n", (folder.path() / "report.html").string());
}

}  // namespace

void add_reproduce_command(CLI::App& app) {
  const auto options = std::make_shared<ReproduceOptions>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "Write a report with the paper's tables and figures, from a few runs");
  command->add_option("DATA", options->still, "recording of a static sensor, for the drift table")
      ->capture_default_str();
  command
      ->add_option("--trajectory", options->trajectory,
                   "recording with ground truth, for the localization figure")
      ->capture_default_str();
  CLI::Option* former = command->add_option("--ride", options->trajectory)->group("");
  command->add_option("-o,--output", options->output,
                      "folder for the results (default: results/<time>_reproduction)");
  command->add_flag("--overwrite", options->overwrite,
                    "replace the results of an earlier run in this folder");
  command->add_option("--trainings", options->trainings,
                      "folder of benchmarks/table1.sh, for the table of networks");
  command->add_option("--segmenter", options->segmenter, "source of the masks: network or masks")
      ->check(CLI::IsMember({"network", "masks"}))
      ->capture_default_str();
  add_frames_option(*command, options->frames, "largest number of frames per recording");
  add_threads_option(*command, options->threads);
  command->callback([options, former] {
    if (former->count() > 0) print_warnings({"--ride is now called --trajectory"});
    reproduce(*options);
  });
}

}  // namespace mms
