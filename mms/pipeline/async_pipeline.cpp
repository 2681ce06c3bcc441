#include "mms/pipeline/async_pipeline.hpp"

#include <tbb/global_control.h>

#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include "mms/core/bounded_queue.hpp"
#include "mms/core/left_out_frames.hpp"
#include "mms/pipeline/mask_policy.hpp"
#include "mms/pipeline/pace.hpp"

namespace mms {
namespace {

using Clock = Pace::Clock;

/// [frames]: capacity of the queue between two stages. Source: initial choice, so that a keyframe's
/// longer mapping does not delay the other stages.
constexpr std::size_t kQueueCapacity = 3;

/// [frames]: the same in real time. Source: a waiting frame adds latency.
constexpr std::size_t kRealtimeCapacity = 1;

/// [-]: keyframes in the queue for loop closure. Source: a graph of 1,000 nodes is solved in the
/// time of a few keyframes.
constexpr std::size_t kKeyframeCapacity = 8;

/// [ms]: a frame that waits longer for the segmentation counts as delayed. Source: initial choice,
/// a third of the time between two frames of a 30 Hz camera.
constexpr std::chrono::milliseconds kMaxQueueWait{10};

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

struct Input {
  Frame frame;
  double read_ms = 0.0;
  std::optional<Clock::time_point> due;    // when it came from the sensor, in real time
  std::optional<Clock::time_point> ready;  // when it was read, in real time
};

struct Segmented {
  Input input;
  TimedSegmentation masks;
};

struct Perceived {
  Input input;
  PerceivedFrame frame;
};

struct Localized {
  Input input;
  FrameResult result;
};

/// A keyframe for the global map, or a lost frame whose place is asked for.
struct LoopTask {
  GlobalKeyframe frame;
  std::variant<std::promise<MapCorrection>, std::promise<std::optional<Relocalization>>> answer;
};

/// Gives the result of a task or its error to the thread that waits for it.
template <class Result, class Compute>
void fulfil(std::promise<Result>& answer, const Compute& compute) {
  try {
    answer.set_value(compute());
  } catch (...) {
    answer.set_exception(std::current_exception());
    throw;
  }
}

/// Whether the segmentation of the frame before delayed this one.
bool had_to_wait(const Input& input) {
  return input.ready && Clock::now() - *input.ready > kMaxQueueWait;
}

std::optional<Input> read(const AsyncPipeline::Source& source, const AsyncOptions& options) {
  const Clock::time_point start = Clock::now();
  std::optional<Frame> frame = source();
  if (!frame) return std::nullopt;
  const Clock::time_point end = Clock::now();
  const auto arrival = options.arrival ? options.arrival() : std::nullopt;
  return Input{std::move(*frame), milliseconds(end - start), arrival,
               arrival ? std::optional(end) : std::nullopt};
}

Processed finished(Input input, FrameResult result) {
  std::optional<double> latency;
  if (input.due) latency = milliseconds(Clock::now() - *input.due);
  return {std::move(input.frame), std::move(result), input.read_ms, latency};
}

/// Lets the threads of a run use the system, and those after it.
class ThreadRelease {
 public:
  explicit ThreadRelease(SlamSystem& system) : system_(system) { system_.release_threads(); }
  ~ThreadRelease() { system_.release_threads(); }
  ThreadRelease(const ThreadRelease&) = delete;
  ThreadRelease& operator=(const ThreadRelease&) = delete;

 private:
  SlamSystem& system_;
};

/// The first exception any of several threads threw.
class FirstError {
 public:
  void keep_current() {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
};

/// The steps of one run, each for its own thread, and the queues between them.
class StageThreads {
 public:
  StageThreads(SlamSystem& system, const AsyncOptions& options)
      : system_(system),
        options_(options),
        inputs_(capacity(options)),
        segmented_(capacity(options)),
        perceived_(capacity(options)),
        localized_(capacity(options)),
        keyframes_(kKeyframeCapacity) {}

  void read_all(const AsyncPipeline::Source& source, std::atomic<std::size_t>& dropped) {
    Pace pace;
    LeftOutFrames left_out;
    while (std::optional<Input> input = read(source, options_)) {
      if (options_.realtime) {
        // Frames of a sensor come by themselves.
        if (!input->due) input->due = input->ready = pace.wait_for(input->frame.stamp);
        left_out.give_to(input->frame);
        left_out.add(input->frame);  // which is gone where there is no room
        if (inputs_.try_push(std::move(*input))) {
          left_out = {};
        } else if (inputs_.is_closed()) {  // another step failed
          break;
        } else {
          ++dropped;
        }
      } else if (!inputs_.push(std::move(*input))) {
        break;
      }
    }
    inputs_.close();
  }

  void segment_all(std::atomic<std::size_t>& without_masks) {
    MaskPolicy policy(options_.max_mask_age);
    while (std::optional<Input> input = inputs_.pop()) {
      TimedSegmentation masks;
      const bool is_scan = input->frame.depth.empty();  // the fusion follows objects in images only
      if (!options_.realtime || is_scan ||
          policy.wants_masks(input->frame.stamp, had_to_wait(*input))) {
        masks = system_.segment(input->frame);
      } else {
        ++without_masks;
      }
      if (!segmented_.push({std::move(*input), std::move(masks)})) break;
    }
    segmented_.close();
  }

  void perceive_all() {
    while (std::optional<Segmented> item = segmented_.pop()) {
      PerceivedFrame frame = system_.perceive(item->input.frame, item->masks);
      if (!perceived_.push({std::move(item->input), std::move(frame)})) break;
    }
    perceived_.close();
  }

  void localize_all() {
    while (std::optional<Perceived> item = perceived_.pop()) {
      FrameResult result = system_.localize(std::move(item->frame));
      if (result.wants_relocalization) result = relocate(item->input.frame, std::move(result));
      if (result.global_keyframe) hand_over(item->input.frame, result);
      if (!localized_.push({std::move(item->input), std::move(result)})) break;
    }
    localized_.close();
    keyframes_.close();
  }

  void close_all_loops() {
    try {
      while (std::optional<LoopTask> task = keyframes_.pop()) close_loops(*task);
    } catch (...) {
      error_.keep_current();  // before others see that there is no answer
      keyframes_.close();
      while (keyframes_.pop()) {
        // Nobody must wait for its answer.
      }
      throw;
    }
  }

  void map_all(const AsyncPipeline::Sink& sink) {
    while (std::optional<Localized> item = localized_.pop()) {
      FrameResult result = system_.map(std::move(item->result));
      sink(finished(std::move(item->input), std::move(result)));
    }
  }

  /// Runs one of the steps; when it throws all of them end.
  template <class Step>
  void guarded(const Step& step) {
    try {
      step();
    } catch (...) {
      error_.keep_current();
      inputs_.close();
      segmented_.close();
      perceived_.close();
      localized_.close();
      keyframes_.close();
    }
  }

  void rethrow() const { error_.rethrow(); }

 private:
  void close_loops(LoopTask& task) {
    if (auto* correction = std::get_if<std::promise<MapCorrection>>(&task.answer)) {
      fulfil(*correction, [&] { return system_.close_loops(task.frame); });
    } else {
      fulfil(std::get<1>(task.answer), [&] { return system_.relocalize(task.frame); });
    }
  }

  /// Waits until the keyframes before are in the global map, so that the answer depends on the
  /// frames alone.
  FrameResult relocate(const Frame& frame, FrameResult lost) {
    std::promise<std::optional<Relocalization>> promise;
    auto answer = promise.get_future();
    keyframes_.push({SlamSystem::global_keyframe(frame, lost), std::move(promise)});
    const std::optional<Relocalization> place = answer.get();
    return place ? system_.relocate(std::move(lost), *place) : std::move(lost);
  }

  /// In real time, loop closure that is late must not delay the pose.
  void hand_over(const Frame& frame, const FrameResult& result) {
    GlobalKeyframe keyframe = SlamSystem::global_keyframe(frame, result);
    keyframe.after_lost |= std::exchange(dropped_after_lost_, false);
    const bool after_lost = keyframe.after_lost;
    std::promise<MapCorrection> promise;
    auto correction = promise.get_future();
    LoopTask task{std::move(keyframe), std::move(promise)};
    const bool taken =
        options_.realtime ? keyframes_.try_push(std::move(task)) : keyframes_.push(std::move(task));
    if (taken) {
      system_.corrections().add(frame.stamp, std::move(correction));
    } else {
      dropped_after_lost_ = after_lost;
    }
  }

  static std::size_t capacity(const AsyncOptions& options) {
    return options.realtime ? kRealtimeCapacity : kQueueCapacity;
  }

  SlamSystem& system_;
  AsyncOptions options_;
  BoundedQueue<Input> inputs_;
  BoundedQueue<Segmented> segmented_;
  BoundedQueue<Perceived> perceived_;
  BoundedQueue<Localized> localized_;
  BoundedQueue<LoopTask> keyframes_;
  bool dropped_after_lost_ = false;  // of a keyframe that was not taken
  FirstError error_;
};

}  // namespace

void AsyncPipeline::run(SlamSystem& system, const Source& source, const Sink& sink) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options_.threads));
  const ThreadRelease release(system);
  system.corrections().set_waiting(!options_.realtime && !options_.live);
  if (options_.threads == 1 && !options_.realtime) {
    run_serial(system, source, sink);
  } else {
    run_threaded(system, source, sink);
  }
}

void AsyncPipeline::run_serial(SlamSystem& system, const Source& source, const Sink& sink) {
  while (std::optional<Input> input = read(source, options_)) {
    FrameResult result = system.process(input->frame);
    sink(finished(std::move(*input), std::move(result)));
  }
}

void AsyncPipeline::run_threaded(SlamSystem& system, const Source& source, const Sink& sink) {
  StageThreads stages(system, options_);
  std::thread reader([&] { stages.guarded([&] { stages.read_all(source, dropped_); }); });
  std::thread segmenter([&] { stages.guarded([&] { stages.segment_all(without_masks_); }); });
  std::thread perceiver([&] { stages.guarded([&] { stages.perceive_all(); }); });
  std::thread localizer([&] { stages.guarded([&] { stages.localize_all(); }); });
  std::thread loop_closer([&] { stages.guarded([&] { stages.close_all_loops(); }); });
  stages.guarded([&] { stages.map_all(sink); });
  reader.join();
  segmenter.join();
  perceiver.join();
  localizer.join();
  loop_closer.join();
  stages.rethrow();
}

}  // namespace mms
