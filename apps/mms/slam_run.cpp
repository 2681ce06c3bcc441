#include "slam_run.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "interrupt.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/config_yaml.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "run_outputs.hpp"
#include "run_record.hpp"
#include "run_setup.hpp"

namespace mms {
namespace {

void check_range(const RunOptions& options, const FrameSource& source) {
  if (options.start < source.size()) return;
  throw DataError("--start", fmt::format("is {}, but {} has {} frames", options.start, options.data,
                                         source.size()));
}

SystemConfig load_settings(const RunOptions& options, const FrameSource& source) {
  SystemConfig config;
  const auto calibration = source.calibration();
  if (calibration && calibration->max_depth) {
    config.static_map.surface.max_depth = *calibration->max_depth;
  }
  if (!options.config.empty()) load_config(options.config, config);
  if (!options.weights.empty()) config.segmentation.weights = options.weights;
  if (options.fusion == "multimodal") config.fusion.mode = FusionMode::kMultimodal;
  if (options.fusion == "vision") config.fusion.mode = FusionMode::kVision;
  if (options.fusion == "none") config.fusion.mode = FusionMode::kNone;
  return config;
}

std::unique_ptr<FrameSource> open_source(const RunOptions& options) {
  auto source = open_dataset(options.data, {.masks = options.masks,
                                            .load_masks = options.segmenter != "none",
                                            .topics = options.topics});
  check_range(options, *source);
  return source;
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

AsyncOptions threads_of(const RunOptions& options, const SystemConfig& config) {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  AsyncOptions async{.threads = options.threads > 0 ? options.threads : cores,
                     .realtime = options.realtime};
  // Only the geometry follows an object without a mask.
  if (config.fusion.mode != FusionMode::kMultimodal) async.max_mask_age = 0.0;
  return async;
}

}  // namespace

SlamRun::SlamRun(const RunOptions& options)
    : options_(options),
      source_(open_source(options)),
      config_(load_settings(options, *source_)),
      system_(config_, make_segmenter(options.segmenter, options.data, config_, *source_)),
      progress_(std::min(options.frames, source_->size() - options.start)) {
  if (!options_.view) return;
  view_ = std::make_unique<LiveView>(*options_.view, options_.data, *source_, config_,
                                     std::min(options.frames, source_->size() - options.start));
}

void SlamRun::play(const std::filesystem::path& folder) {
  try {
    process(folder);
  } catch (...) {
    journal_.reset();  // it keeps the frames there are, or goes before its folder does
    throw;
  }
}

/// The network plans its work at its first picture, which would cost the first frames in real time.
void SlamRun::warm_up() {
  const auto calibration = source_->calibration();
  if (options_.segmenter != "network" || !calibration || !calibration->camera) return;
  Frame frame;
  frame.color = Image<Rgb>(calibration->camera->width, calibration->camera->height);
  system_.segment(frame);
}

void SlamRun::process(const std::filesystem::path& folder) {
  const auto warn = [this](const std::string& message) { progress_.warn(message); };
  source_->on_warning(warn);
  journal_ = std::make_unique<RunJournal>(folder, options_.data, config_, warn);
  log_ = std::make_unique<RunLog>(source_->ground_truth(), options_.segmenter == "network",
                                  config_.dynamic_map);
  const InterruptGuard interrupt;
  if (options_.realtime) warm_up();
  AsyncPipeline pipeline(threads_of(options_, config_));
  pipeline.run(system_, limited(*source_, options_),
               [&](Processed&& processed) { finish_frame(std::move(processed)); });
  end_map();
  progress_.finish();
  interrupted_ = InterruptGuard::requested();
  if (interrupted_) progress_.warn("interrupted, writing what is done so far");
  log_->finish(source_->skipped(), pipeline, system_);
  if (log_->frames().empty()) {
    throw DataError(options_.data,
                    fmt::format("none of its {} frames could be processed", source_->size()),
                    "the warnings above say why; mms info DATA explains what was found");
  }
  compare_with_truth();
}

/// Called right after the system localised the frame, before the next one.
void SlamRun::finish_frame(Processed processed) {
  std::optional<MapChanges> map;
  if (processed.result.keyframe) map = system_.static_map().changes();
  std::shared_ptr<const MapChanges> shown;
  if (view_ && map) shown = std::make_shared<const MapChanges>(*map);
  journal_->add(processed, std::move(map));
  log_->add(processed);
  progress_.show(*log_);
  if (view_) view_->show(std::move(processed), std::move(shown));
}

void SlamRun::end_map() {
  std::optional<MapChanges> map = system_.end();
  if (!map) return;
  if (view_) view_->show_map(*map);
  journal_->end(std::move(*map));
}

/// Truth that cannot be read costs the comparison, not the run.
void SlamRun::compare_with_truth() {
  const auto attempt = [&](const std::string& what, const auto& compare) {
    try {
      compare();
    } catch (const Error& error) {
      progress_.warn(what + " not evaluated: " + error.what());
    }
  };
  attempt("the map is", [&] {
    const std::optional<TruthCloud> truth = source_->map_truth();
    if (truth) log_->compare_map(*truth, system_.static_map().cloud().points);
  });
  attempt("the objects are", [&] { log_->compare_objects(source_->objects_truth()); });
}

void SlamRun::write(const std::filesystem::path& folder) {
  write_outputs(folder, options_.data, config_, system_, *log_);
  const auto calibration = source_->calibration();
  write_run_record(folder,
                   record_of(options_, calibration ? calibration->camera : std::nullopt,
                             log_->has_image(), system_.static_map().voxel_size()),
                   *log_);
  if (!options_.keep_journal) journal_->remove();
}

void SlamRun::keep_showing(const std::filesystem::path& folder) {
  if (!view_) return;
  view_->end(folder, *log_);
  if (interrupted_) return;
  if (isatty(STDIN_FILENO) == 0) {
    fmt::print(stderr, "the viewer ends with the run; mms view {} shows it again\n",
               folder.string());
    return;
  }
  fmt::print(stderr, "the viewer stays at {} until Ctrl-C\n", view_->url());
  wait_for_interrupt();
}

}  // namespace mms
