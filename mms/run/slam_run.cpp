#include "mms/run/slam_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/geometry/noise_measurement.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/results/run_outputs.hpp"
#include "mms/run/run_heading.hpp"
#include "mms/run/segmenter/network_detector.hpp"
#include "mms/run/segmenter/segmenter_choice.hpp"
#include "mms/run/sensor_settings.hpp"

namespace mms {
namespace {

void check_range(const RunOptions& options, const FrameSource& source) {
  if (options.start < source.size()) return;
  throw DataError("--start", fmt::format("is {}, but {} has {} frames", options.start, options.data,
                                         source.size()));
}

/// A live source has no end, whatever is skipped at its start.
std::size_t frames_to_process(const RunOptions& options, const FrameSource& source) {
  if (source.size() == FrameSource::kEndless) return options.frames;
  return std::min(options.frames, source.size() - options.start);
}

/// @param warnings  receives warnings about the settings
SystemConfig load_settings(const RunOptions& options, const FrameSource& source,
                           const std::optional<Frame>& first, std::vector<std::string>& warnings) {
  SystemConfig config = with_options(
      sensor_settings(source.calibration().get(), options.config, options.set, "--set", warnings),
      options);
  if (first && config.measure_depth_noise) {
    config.noise.depth = measured_noise(config.noise.depth, first->depth);
  }
  return config;
}

std::unique_ptr<FrameSource> open_source(const RunOptions& options) {
  auto source = open_dataset(options.data, {.masks = options.masks,
                                            .load_masks = options.segmenter != "none",
                                            .map_truth = options.map_truth,
                                            .topics = options.topics,
                                            .camera = options.camera,
                                            .rate = options.rate,
                                            .motion = options.motion});
  check_range(options, *source);
  return source;
}

/// The first frame of the run.
/// @param warnings  receives those of frames that cannot be read
std::optional<Frame> read_first(const RunOptions& options, FrameSource& source,
                                std::vector<std::string>& warnings) {
  source.on_warning([&](const std::string& message) { warnings.push_back(message); });
  source.skip(options.start);
  std::optional<Frame> first = source.next();
  source.on_warning({});  // a live one goes on
  return first;
}

[[noreturn]] void throw_no_frames(const RunOptions& options, const FrameSource& source,
                                  bool interrupted) {
  if (interrupted) throw DataError(options.data, "was interrupted before its first frame");
  if (source.size() == FrameSource::kEndless) {
    throw DataError(options.data,
                    options.start == 0
                        ? "none of its frames could be processed"
                        : fmt::format("none of its frames after the first {} could be processed",
                                      options.start),
                    "see the warnings above");
  }
  throw DataError(options.data,
                  fmt::format("none of its {} frames could be processed", source.size()),
                  "see the warnings above; mms info DATA describes the recording");
}

AsyncOptions threads_of(const RunOptions& options, const SystemConfig& config,
                        const FrameSource& source) {
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  AsyncOptions async{.threads = options.threads > 0 ? options.threads : cores,
                     .realtime = options.realtime,
                     .live = source.size() == FrameSource::kEndless,
                     .arrival = [&source] { return source.arrival(); }};
  // Without a mask, objects are tracked by geometry only.
  if (config.fusion.mode != FusionMode::kMultimodal) async.max_mask_age = 0.0;
  return async;
}

}  // namespace

SlamRun::SlamRun(const RunOptions& options) : SlamRun(options, open_source(options)) {}

SlamRun::SlamRun(const RunOptions& options, std::unique_ptr<FrameSource> source)
    : options_(options),
      source_(std::move(source)),
      first_(read_first(options, *source_, warnings_)),
      config_(load_settings(options, *source_, first_, warnings_)),
      system_(config_, make_segmenter(options.segmenter, options.data, config_, *source_)),
      map_({options_.map, options_.save_map, options_.localize, options_.overwrite, options_.data},
           config_),
      frames_(frames_to_process(options, *source_)) {
  if (!options_.view) return;
  view_ = std::make_unique<LiveView>(*options_.view, options_.data, *source_, config_, frames_);
}

void SlamRun::play(const std::filesystem::path& folder, RunObserver& observer) {
  try {
    process(folder, observer);
    source_->on_warning({});  // a live one goes on
  } catch (...) {
    source_->on_warning({});
    journal_.reset();  // it keeps existing frames; closed before its folder is removed
    recorder_.reset();
    throw;
  }
}

/// The network prepares its kernels with the first image, which would delay the first frames in
/// real time.
void SlamRun::warm_up() {
  const auto calibration = source_->calibration();
  if (options_.segmenter != "network" || !calibration || !calibration->camera) return;
  Frame frame;
  frame.color = Image<Rgb>(calibration->camera->width, calibration->camera->height);
  system_.segment(frame);
}

void SlamRun::process(const std::filesystem::path& folder, RunObserver& observer) {
  const auto handler = [this, &observer](const std::string& message) { warn(message, observer); };
  const std::vector<std::string> of_settings = std::exchange(warnings_, {});
  source_->on_warning(handler);
  journal_ = std::make_unique<RunJournal>(folder, options_.data, config_, handler);
  if (options_.mcap) recorder_ = std::make_unique<RunRecorder>(folder, handler);
  if (view_) view_->keep_on_disk(folder);
  observer.on_start(run_heading(options_, *source_, config_, frames_, folder), frames_);
  for (const std::string& warning : of_settings) warn(warning, observer);
  map_.load(system_, source_->calibration().get(), handler);
  if (options_.realtime) warm_up();
  AsyncPipeline pipeline(threads_of(options_, config_, *source_));
  // The check takes about 0.5 s, which a run in real time does not have.
  if (!options_.realtime) check_.emplace();
  log_ = std::make_unique<RunLog>(source_->ground_truth(), options_.segmenter == "network",
                                  config_.dynamic_map, folder);  // its clock starts here
  pipeline.run(system_, frames_for(observer),
               [&](Processed&& processed) { finish_frame(std::move(processed), observer); });
  end_map();
  report_implausible(observer);
  if (repeated_.count() > 0) {
    warn(fmt::format("{} frames that repeat an image or scan were left out", repeated_.count()),
         observer);
  }
  observer.on_end();
  interrupted_ = observer.stop_requested();
  if (log_->size() == 0) throw_no_frames(options_, *source_, interrupted_);
  if (interrupted_) warn("interrupted, writing the results so far", observer);
  log_->finish(source_->skipped() + repeated_.count(), source_->dropped() + stale_, pipeline,
               system_);
  warn_if_not_localized(observer);
  warn_of_sessions_outside(observer);
  warn_of_other_axes(observer);
  compare_with_truth(observer);
}

/// The requested frames but repeated ones, and in real time those that arrived before now; none
/// after the observer ended the run, or the run gave up.
AsyncPipeline::Source SlamRun::frames_for(RunObserver& observer) {
  const auto begin = std::chrono::steady_clock::now();
  return [this, &observer, begin, left = options_.frames]() mutable -> std::optional<Frame> {
    while (left > 0 && !observer.stop_requested() && !gave_up_) {
      std::optional<Frame> frame = first_ ? std::exchange(first_, std::nullopt) : source_->next();
      if (!frame) return std::nullopt;
      const auto arrival = source_->arrival();
      if (options_.realtime && arrival && *arrival < begin) {
        ++stale_;
        continue;
      }
      --left;
      if (is_repeated(*frame, observer)) continue;
      check_plausibility(*frame, observer);
      return frame;
    }
    return std::nullopt;
  };
}

/// Whether a frame is to be left out. Called in the reading thread.
bool SlamRun::is_repeated(Frame& frame, RunObserver& observer) {
  return repeated_.omits(frame, [&](const std::string& line) { warn(line, observer); });
}

/// Shows a warning, and keeps it for the report: the first ones of each kind, so that those of
/// hours of frames leave room for what is said at the end.
void SlamRun::warn(const std::string& message, RunObserver& observer) {
  constexpr std::size_t kKept = 40;
  {
    const std::scoped_lock lock(warnings_mutex_);
    if (repeated_warnings_.add(message) && warnings_.size() < kKept) warnings_.push_back(message);
  }
  observer.on_warning(message);
}

/// Checks frames of about the first second; called in the reading thread.
void SlamRun::check_plausibility(const Frame& frame, RunObserver& observer) {
  constexpr std::int64_t kStride = 4;  // frames; neighbors are too similar
  if (!check_) return;
  if (check_->frames_in_sequence() < RecordingCheck::kSequence) check_->add_in_sequence(frame);
  if ((frame.index - static_cast<std::int64_t>(options_.start)) % kStride != 0) return;
  check_->add(frame);
  if (check_->frames() >= RecordingCheck::kFrames) report_implausible(observer);
}

void SlamRun::report_implausible(RunObserver& observer) {
  if (!check_) return;
  for (const std::string& fault : check_->faults()) warn("implausible: " + fault, observer);
  check_.reset();
}

/// Gives up where the first seconds show that the recording cannot be localized.
void SlamRun::check_lost() {
  constexpr std::size_t kMinFrames = 50;
  constexpr double kMinTime = 5.0;    // [s]; cameras are covered or shaken for shorter
  constexpr double kMaxShare = 0.95;  // of lost frames
  const std::size_t frames = log_->size();
  if (log_->last().status == Status::kLost) ++lost_;
  if (gave_up_ || frames < kMinFrames || source_->size() == FrameSource::kEndless) return;
  if (to_seconds(log_->last().stamp - log_->first().stamp) < kMinTime) return;
  if (static_cast<double>(lost_) < kMaxShare * static_cast<double>(frames)) return;
  failure_ =
      fmt::format("{} of its first {} frames were lost, so the run ended there", lost_, frames);
  gave_up_ = true;
}

/// Called after the pose of the frame was estimated, before the next frame.
void SlamRun::finish_frame(Processed processed, RunObserver& observer) {
  map_.add(processed.result);
  std::optional<MapChanges> map;
  if (processed.result.keyframe) map = system_.mapping().changes();
  std::shared_ptr<const MapChanges> shown;
  if (view_ && map) shown = std::make_shared<const MapChanges>(*map);
  journal_->add(processed, std::move(map));
  if (recorder_) recorder_->add(processed, system_.static_map());
  log_->add(processed);
  for (const std::string& warning : processed.result.warnings) warn(warning, observer);
  warn_of_losses(processed, observer);
  check_lost();
  if (sink_) sink_(processed, system_);
  observer.on_frame(*log_);
  if (!view_) return;
  view_->show(std::move(processed), log_->last().interval_ms, std::move(shown), system_.mapping());
}

void SlamRun::warn_of_losses(const Processed& processed, RunObserver& observer) {
  const FrameResult& result = processed.result;
  const auto tell = [&](const std::string& what) {
    warn(fmt::format("frame {}: {}", processed.frame.name, what), observer);
  };
  const bool begins = result.session != std::exchange(session_, result.session);
  is_outside_ |= begins;
  if (begins && result.relocalized) {
    tell(fmt::format("relocalized at a place of an earlier session; session {} begins there",
                     result.session));
  } else if (begins) {
    tell(
        fmt::format("session {} begins after a long loss: its place in the map is unknown until "
                    "it sees a known place",
                    result.session));
  } else if (result.relocalized) {
    tell("relocalized");
  }
  if (!is_outside_ || !result.correction.T_global_world) return;
  is_outside_ = false;
  if (!begins) tell(fmt::format("session {} has its place in the map", result.session));
}

void SlamRun::warn_if_not_localized(RunObserver& observer) {
  const auto& loops = log_->metrics().loops;
  if (!loops || !loops->earlier_map || loops->earlier_map->localized_s) return;
  const char* what = loops->earlier_map->closed == 0
                         ? "no place of {} was recognized"
                         : "no place of {} was recognized that is joined to its first session";
  warn(fmt::format(fmt::runtime(std::string(what) + ": the results are in a frame of their own"),
                   options_.map.string()),
       observer);
}

void SlamRun::warn_of_sessions_outside(RunObserver& observer) {
  const auto& places = log_->places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].is_known) continue;
    warn(fmt::format("session {} has no place in the map: its map and poses are in outside_map", i),
         observer);
  }
}

void SlamRun::warn_of_other_axes(RunObserver& observer) {
  const auto& trajectory = log_->metrics().trajectory;
  if (!trajectory || !trajectory->rpe.axes_differ) return;
  warn(
      "the ground truth moves along other axes than the sensor: it seems to be of another sensor "
      "or body, so that RPE has no meaning",
      observer);
}

void SlamRun::end_map() {
  std::optional<MapChanges> map = system_.finalize();
  if (!map) return;
  if (view_) view_->show_map(*map);
  journal_->end(std::move(*map));
}

/// Unreadable ground truth prevents the comparison, not the run.
void SlamRun::compare_with_truth(RunObserver& observer) {
  if (!options_.map_truth) return;
  const auto attempt = [&](const std::string& what, const auto& compare) {
    try {
      compare();
    } catch (const Error& error) {
      warn(what + " not evaluated: " + error.what(), observer);
    }
  };
  attempt("the map is", [&] {
    const std::optional<TruthCloud> truth = source_->map_truth();
    if (truth) {
      const MapCloud map = result_map(system_.mapping(), MapFrame::kCamera, log_->places());
      log_->compare_map(*truth, map.points);
    }
  });
  attempt("the objects are", [&] { log_->compare_objects(source_->objects_truth()); });
}

void SlamRun::write(const std::filesystem::path& folder) {
  finish_recording();
  const std::vector<std::string> warnings = [this] {
    const std::scoped_lock lock(warnings_mutex_);  // the journal may add one
    std::vector<std::string> all = warnings_;
    for (std::string& line : repeated_warnings_.rest()) all.push_back(std::move(line));
    return all;
  }();
  write_outputs(folder, options_.data, config_, system_, *log_, warnings);
  const auto calibration = source_->calibration();
  write_run_record(folder,
                   record_of(options_, calibration ? calibration->camera : std::nullopt,
                             log_->has_image(), system_.static_map().voxel_size()),
                   *log_);
  if (!options_.keep_journal) journal_->remove();
}

void SlamRun::finish_recording() {
  if (!recorder_) return;
  const MapFrame frame = log_->has_image() ? MapFrame::kCamera : MapFrame::kLidar;
  recorder_->finish(result_map(system_.mapping(), frame, log_->places()),
                    are_corrected(log_->places()) ? log_->corrected_trajectory() : Trajectory());
  recorder_.reset();
}

bool SlamRun::save_map(RunObserver& observer) {
  return map_.save(system_, [&](const std::string& message) { observer.on_warning(message); });
}

}  // namespace mms
