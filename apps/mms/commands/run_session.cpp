#include "apps/mms/commands/run_session.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/mms/console/common_options.hpp"
#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/progress.hpp"
#include "apps/mms/console/viewing.hpp"
#include "apps/mms/console/warnings.hpp"
#include "mms/core/error.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/map_file/map_file.hpp"
#include "mms/run/results/result_folder.hpp"
#include "mms/run/results/run_map.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/run/sensor_settings.hpp"

namespace mms {
namespace {

/// Prints the summary of a run and its folder on stdout.
void print_summary(const std::filesystem::path& folder, const RunMetrics& metrics,
                   const ConsoleOptions& console) {
  if (console.json) {
    fmt::print("{}", to_json(metrics));
    return;
  }
  if (console.quiet) return;
  fmt::print("{}", to_table(metric_sections(metrics)));
  fmt::print("report: {}\nmap:    {}\n", (folder / "report.html").string(),
             (folder / "static_map.ply").string());
}

/// Passes the result folder to viewers. On a terminal it keeps serving until Ctrl-C; in a script it
/// returns.
void keep_showing(const SlamRun& run, const std::filesystem::path& folder) {
  run.view()->end(folder, run.log());
  if (run.interrupted()) return;
  if (isatty(STDIN_FILENO) == 0) {
    fmt::print(stderr, "the viewer ends with the run; mms view {} shows it again\n",
               folder.string());
    return;
  }
  fmt::print(stderr, "the viewer runs at {} until Ctrl-C\n", run.view()->server().url());
  wait_for_interrupt();
}

/// Says how to get the results of a run that failed after some frames.
void tell_recoverable(const std::filesystem::path& folder, Progress& progress) {
  std::error_code error;
  if (!std::filesystem::exists(folder / kJournalName, error)) return;
  progress.on_warning(
      fmt::format("the frames before the error are kept: mms convert {} -o NEW", folder.string()));
}

}  // namespace

void add_result_options(CLI::App& command, RunOptions& options) {
  command.add_option("-c,--config", options.config,
                     "settings file (mms config dump prints all settings)");
  add_set_option(command, options.set);
  command.add_option("-o,--output", options.output,
                     "folder for the results (default: results/<time>_<name>)");
  command.add_flag("--overwrite", options.overwrite,
                   "replace the results of an earlier run in this folder");
}

void add_mapping_options(CLI::App& command, RunOptions& options) {
  command
      .add_option("--fusion", options.fusion,
                  "how points are labeled dynamic (default: that of the settings, multimodal)")
      ->check(CLI::IsMember({"multimodal", "vision", "none"}));
  command
      .add_option("--loops", options.loops,
                  "close loops and write the corrected trajectory_map.tum (default: that of the "
                  "settings, on)")
      ->check(CLI::IsMember({"on", "off"}));
  command
      .add_option("--save-map", options.save_map,
                  "write the map to this file, to localize in it later")
      ->type_name("FILE");
  command
      .add_option("--map", options.map,
                  "localize in this map, and add the run to it; with --save-map to a copy")
      ->type_name("FILE");
  command.add_flag("--localize,--localise", options.localize,
                   "localize in the map of --map without changing it");
}

void add_recording_options(CLI::App& command, RunOptions& options) {
  add_threads_option(
      command, options.threads,
      "threads to use (default: one per core); the results are the same for any number");
  command.add_flag("--keep-journal", options.keep_journal,
                   "keep journal.bin after the run (mms convert recovers killed runs from it)");
  command.add_flag("--mcap", options.mcap,
                   "record poses, maps, objects and images in run.mcap, for Foxglove and ROS 2");
}

void add_console_options(CLI::App& command, ConsoleOptions& console, ViewChoice& view) {
  command.add_flag("-q,--quiet", console.quiet, "print only warnings and errors");
  command.add_flag("--json", console.json, "print metrics.json in place of the summary");
  command.add_option("--view", view.word, "show the live run in a browser, at this port (8080)")
      ->expected(0, 1)
      ->type_name("[PORT]");
  add_bind_option(command, view.place);
}

void play_and_write(SlamRun& run, const ConsoleOptions& console) {
  const RunOptions& options = run.options();
  if (run.view() != nullptr) announce(run.view()->server(), *options.view);
  const InterruptGuard interrupt;  // also while the results are written
  ResultFolder folder(options.output, options.data, options.overwrite);
  const std::string place = folder.path().string();
  Progress progress(console.quiet);
  try {
    run.play(folder.path(), progress);
    if (folder.restore()) {
      print_warnings({place + " was removed during the run; the results are written to " +
                      folder.path().string()});
    }
    run.write(folder.path());
  } catch (...) {
    if (run.interrupted() && run.log().size() == 0) {
      throw Interrupted("no frame was processed, so there are no results");
    }
    tell_recoverable(folder.path(), progress);
    throw;
  }
  folder.make_latest();
  print_summary(folder.path(), run.log().metrics(), console);
  const bool is_saved = run.failure().empty() && run.save_map(progress);  // no map of lost frames
  if (is_saved && !console.json && !console.quiet) {
    fmt::print("saved:  {}\n",
               (options.save_map.empty() ? options.map : options.save_map).string());
  }
  if (!run.failure().empty()) {
    throw DataError(options.data, run.failure(),
                    "check its calibration and depth with mms info, and see the warnings above");
  }
  const bool continues = console.continues && console.continues();
  if (run.view() != nullptr && !continues) keep_showing(run, folder.path());
}

/// Finds faults before the wait for the first frame.
void check_settings(const RunOptions& options) {
  std::vector<std::string> warnings;  // the run has them again
  const SystemConfig config = with_options(
      sensor_settings(nullptr, options.config, options.set, "--set", warnings), options);
  if (options.segmenter == "network") {
    const std::filesystem::path weights = weights_path(config.segmentation.weights);
    if (!std::filesystem::exists(weights)) throw FileError(weights.string(), "no such file");
  }
  check_map_options(
      {options.map, options.save_map, options.localize, options.overwrite, options.data}, config);
  if (!options.map.empty()) const MapFile readable(options.map, MapFile::Mode::kRead);
  if (!options.output.empty() && !options.overwrite) {
    const ResultFolder free(options.output, options.data, false);  // removed if it is new
  }
}

bool run_live(const RunOptions& options, const ConsoleOptions& console,
              std::unique_ptr<LiveSource> source, SlamRun::ResultSink sink) {
  const InterruptGuard interrupt;
  check_settings(options);
  if (!source->wait([](const std::string& message) { print_warnings({message}); })) {
    if (!InterruptGuard::requested()) return false;
    throw Interrupted("no frame was received, so there are no results");
  }
  SlamRun run(options, std::move(source));
  run.on_result(std::move(sink));
  play_and_write(run, console);
  return true;
}

}  // namespace mms
