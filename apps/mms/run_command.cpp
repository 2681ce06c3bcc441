#include "run_command.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "interrupt.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/config_yaml.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/segmentation/mask_segmenter.hpp"
#include "mms/segmentation/none_segmenter.hpp"
#include "network_detector.hpp"
#include "progress.hpp"
#include "result_folder.hpp"
#include "run_journal.hpp"
#include "run_log.hpp"
#include "run_options.hpp"
#include "run_outputs.hpp"

namespace mms {
namespace {

constexpr int kMaxCount = 1'000'000'000;  // of frames

SystemConfig load_settings(const RunOptions& options, const FrameSource& source) {
  SystemConfig config;
  const auto calibration = source.calibration();
  if (calibration && calibration->max_depth) {
    config.static_map.surface.max_depth = *calibration->max_depth;
  }
  if (!options.config.empty()) load_config(options.config, config);
  if (options.fusion == "multimodal") config.fusion.mode = FusionMode::kMultimodal;
  if (options.fusion == "vision") config.fusion.mode = FusionMode::kVision;
  if (options.fusion == "none") config.fusion.mode = FusionMode::kNone;
  return config;
}

std::unique_ptr<Segmenter> make_segmenter(const RunOptions& options, const SystemConfig& config,
                                          const FrameSource& source) {
  if (options.segmenter == "none") return std::make_unique<NoneSegmenter>();
  if (options.segmenter == "network") return make_network_segmenter(config.segmentation);
  if (!source.has_masks()) {
    throw DataError(options.data, "has no masks",
                    "put label images into its masks/ folder, give --masks DIR, or choose "
                    "--segmenter network or none");
  }
  return std::make_unique<MaskSegmenter>();
}

/// The frames asked for, and no more; none after Ctrl-C.
AsyncPipeline::Source limited(FrameSource& source, const RunOptions& options) {
  source.skip(options.start);
  return [&source, left = options.frames]() mutable -> std::optional<Frame> {
    if (left == 0 || InterruptGuard::requested()) return std::nullopt;
    --left;
    return source.next();
  };
}

void check_range(const RunOptions& options, const FrameSource& source) {
  if (options.start < source.size()) return;
  throw DataError("--start", fmt::format("is {}, but {} has {} frames", options.start, options.data,
                                         source.size()));
}

AsyncOptions threads_of(const RunOptions& options) {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return {.threads = options.threads > 0 ? options.threads : cores, .realtime = options.realtime};
}

/// Truth that cannot be read costs the comparison, not the run.
void compare_with_truth(const FrameSource& source, const SlamSystem& system, RunLog& log,
                        Progress& progress) {
  const auto attempt = [&](const std::string& what, const auto& compare) {
    try {
      compare();
    } catch (const Error& error) {
      progress.warn(what + " not evaluated: " + error.what());
    }
  };
  attempt("the map is", [&] {
    const std::optional<TruthCloud> truth = source.map_truth();
    if (truth) log.compare_map(*truth, system.static_map().cloud().points);
  });
  attempt("the objects are", [&] { log.compare_objects(source.objects_truth()); });
}

void run(const RunOptions& options) {
  const std::unique_ptr<FrameSource> source = open_dataset(
      options.data, {.masks = options.masks, .load_masks = options.segmenter != "none"});
  const SystemConfig config = load_settings(options, *source);
  check_range(options, *source);
  SlamSystem system(config, make_segmenter(options, config, *source));
  const ResultFolder folder(options.output, options.data);

  Progress progress(std::min(options.frames, source->size() - options.start));
  source->on_warning([&](const std::string& message) { progress.warn(message); });
  RunJournal journal(folder.path(), options.data, config,
                     [&](const std::string& message) { progress.warn(message); });
  RunLog log(source->ground_truth(), options.segmenter == "network");
  const InterruptGuard interrupt;
  AsyncPipeline pipeline(threads_of(options));
  pipeline.run(system, limited(*source, options), [&](const Processed& processed) {
    journal.add(processed, system);
    log.add(processed);
    progress.show(log);
  });
  progress.finish();
  if (InterruptGuard::requested()) progress.warn("interrupted, writing what is done so far");
  log.finish(source->skipped() + pipeline.dropped(), system);
  if (log.frames().empty()) {
    throw DataError(options.data,
                    fmt::format("none of its {} frames could be processed", source->size()),
                    "the warnings above say why; mms info DATA explains what was found");
  }
  compare_with_truth(*source, system, log, progress);
  write_outputs(folder.path(), options.data, config, system, log);
  if (!options.keep_journal) journal.remove();
  folder.make_latest();
  print_summary(folder.path(), log);
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Localise a recording and map its surroundings");
  command
      ->add_option("DATA", options->data,
                   "recording, or a simulation: sim:warehouse_loop[?seed=N&frames=N]")
      ->capture_default_str();
  command->add_option("-c,--config", options->config, "settings (mms config dump prints them all)");
  command->add_option("-o,--output", options->output,
                      "folder for the results (default: results/<time>_<name>)");
  command
      ->add_option("--segmenter", options->segmenter,
                   "where masks of people and vehicles come from: a network, the recording's "
                   "masks/ (or --masks), or nowhere")
      ->check(CLI::IsMember({"network", "masks", "none"}))
      ->default_str("network, or masks with --masks");
  command->add_option("--masks", options->masks, "folder of label images named like the frames");
  command
      ->add_option("--fusion", options->fusion,
                   "what makes a point dynamic (default: as the settings say, multimodal)")
      ->check(CLI::IsMember({"multimodal", "vision", "none"}));
  command->add_option("--frames", options->frames, "process at most N frames")
      ->check(CLI::Range(1, kMaxCount))
      ->default_str("all");
  command->add_option("--start", options->start, "pass over the first K frames")
      ->check(CLI::Range(0, kMaxCount))
      ->capture_default_str();
  command->add_flag("--realtime", options->realtime,
                    "play at the recording's pace and drop frames that come too fast");
  command
      ->add_option("--threads", options->threads,
                   "threads to use (default: one a core); the results are the same for any number")
      ->check(CLI::Range(1, 256));
  command->add_flag("--keep-journal", options->keep_journal,
                    "leave journal.bin, from which mms convert recovers a run that was killed, in "
                    "the folder of a run that came to its end");
  command->callback([options] {
    if (options->segmenter.empty())
      options->segmenter = options->masks.empty() ? "network" : "masks";
    run(*options);
  });
}

}  // namespace mms
