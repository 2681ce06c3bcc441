#include "apps/mms/commands/commands.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/mms/commands/training_set_command.hpp"
#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "apps/mms/console/thread_limit.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/dataset/simulated/simulated_source.hpp"
#include "mms/dataset/simulated/simulation_writer.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/text/nearest_word.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  std::string scene = "warehouse_loop";
  fs::path output;
  std::string seed, frames, sensor, hz, blur;  ///< empty: that of the scene
  std::vector<std::string> set;                ///< key=value
  int threads = 0;                             ///< 0: one per core
  bool print = false;
  bool overwrite = false;
};

/// A built-in scene, an address as for `mms run` (sim:crowd?seed=3), or a YAML file.
SceneConfig load_scene(const std::string& scene) {
  if (is_simulated(scene)) return simulated_scene(scene);
  const auto names = scene_names();
  if (std::find(names.begin(), names.end(), scene) != names.end()) return scene_config(scene);
  if (!fs::exists(scene)) {
    const std::vector<std::string> known(names.begin(), names.end());
    const std::string hint = scene.find('?') == std::string::npos
                                 ? suggestion(scene, known)
                                 : "with values it is sim:" + scene;
    throw DataError(scene, "no such scene and no such YAML file", hint);
  }
  SceneConfig config;
  print_warnings(load_config(scene, config));
  config.name = fs::path(scene).stem().string();
  return config;
}

SceneConfig config_of(const SimulateOptions& options) {
  SceneConfig config = load_scene(options.scene);
  const auto set = [&](const char* flag, const char* key, const std::string& value) {
    if (value.empty()) return;
    assign(config, std::vector{std::string(key) + "=" + value}, flag);
  };
  set("--seed", "seed", options.seed);
  set("--frames", "frames", options.frames);
  set("--sensor", "sensor", options.sensor);
  set("--hz", "hz", options.hz);
  set("--blur", "blur_samples", options.blur);
  print_warnings(assign(config, options.set, "--set"));
  return config;
}

void print_summary(const fs::path& folder, const SimulatedScene& scene,
                   const WrittenRecording& written, double seconds) {
  fmt::print(
      "{}: {} frames of {}, {:.1f} frames/s; {} instances, {} static points, {} ground-truth map "
      "points\n",
      folder.string(), written.frames, scene.sensor().name, written.frames / seconds,
      written.annotations, written.static_points, written.map_points);
  fmt::print("play it: mms run {}\n", folder.string());
}

void simulate(const SimulateOptions& options) {
  const SceneConfig config = config_of(options);
  if (options.print) {
    fmt::print("{}", scene_yaml(config));
    return;
  }
  if (options.output.empty()) throw CLI::RequiredError("--output");
  const ThreadLimit limit(options.threads);
  SimulatedScene scene(config);
  RateProgress progress("frame");
  const InterruptGuard interrupt;
  WriteOptions write;
  write.overwrite = options.overwrite;
  write.progress = [&](int done, int total) {
    progress.show(done, total);
    return !InterruptGuard::requested();
  };
  const WrittenRecording written = write_simulation(scene, options.output, write);
  progress.finish();
  print_summary(options.output, scene, written, progress.seconds());
  if (InterruptGuard::requested()) {
    throw Interrupted(fmt::format("{} of {} frames are written", written.frames, scene.size()));
  }
}

/// "a, b, c", for the help.
std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(
      "simulate", "Render a simulated warehouse into a recording with exact ground truth");
  command
      ->add_option("SCENE", options->scene,
                   "YAML file of a scene (--print shows one), or one of " + listed(scene_names()) +
                       ", also as for mms run: sim:crowd?seed=3")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "output folder for the recording");
  command->add_flag("--overwrite", options->overwrite,
                    "replace an earlier simulation in this folder");
  command->add_option("--seed", options->seed, "seed of all random numbers");
  command->add_option("--frames", options->frames, "number of frames (default: that of the scene)");
  command->add_option("--sensor", options->sensor, "one of " + listed(sensor_names()));
  command->add_option("--hz", options->hz, "frame rate [Hz] (default: that of the scene)");
  command->add_option("--blur", options->blur, "renderings per exposure; 1: no blur");
  command
      ->add_option("--set", options->set,
                   "any setting of the scene, as key=value or group.key=value; repeatable")
      ->allow_extra_args(false);
  add_threads_option(*command, options->threads);
  command->add_flag("--print", options->print, "only print the scene as YAML with descriptions");
  add_training_set_command(*command);
  command->callback([options, command] {
    if (command->get_subcommands().empty()) simulate(*options);
  });
}

}  // namespace mms
