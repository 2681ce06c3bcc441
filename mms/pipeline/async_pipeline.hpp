#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

#include "mms/core/frame.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/pipeline/slam_system.hpp"

namespace mms {

struct AsyncOptions {
  int threads = 2;  ///< 1 runs every step in the calling thread
  /// Frames come at the pace of their stamps. Those that find no room are dropped; those that wait
  /// while the network is at work on another go without masks of their own, as long as the last
  /// ones are not older than `max_mask_age`: the fusion follows the objects meanwhile. Scans wait.
  bool realtime = false;
  bool live = false;          ///< a sensor: no pose waits for loop closure
  double max_mask_age = 0.1;  ///< [s]; 0: every frame has masks of its own
  /// When the frame that the source gave last arrived, if it is live; called after the source. In
  /// real time, frames without it have their times by their stamps.
  std::function<std::optional<std::chrono::steady_clock::time_point>()> arrival{};
};

/// A frame with its results.
struct Processed {
  Frame frame;
  FrameResult result;
  double read_ms = 0.0;              ///< time the source took for the frame
  std::optional<double> latency_ms;  ///< of live sensors and in real time: since the frame came
};

/// Runs a SlamSystem over a stream: reading, segmentation, fusion with features, localisation, and
/// mapping of successive frames overlap in threads joined by bounded queues, so that a keyframe's
/// mapping does not keep the next pose waiting. The steps and their order are those of
/// `SlamSystem::process`, so that without `realtime` the results are the same bits for any number
/// of threads.
class AsyncPipeline {
 public:
  using Source = std::function<std::optional<Frame>()>;
  using Sink = std::function<void(Processed&&)>;

  explicit AsyncPipeline(const AsyncOptions& options) : options_(options) {}

  /// Processes all frames of `source` and hands them to `sink`, which may keep them, in order and
  /// in the calling thread, in which the maps are made: they are as of that frame.
  /// @throws what source, system or sink throw, after the threads have ended.
  void run(SlamSystem& system, const Source& source, const Sink& sink);

  /// Frames dropped in real time so far.
  std::size_t dropped() const { return dropped_; }

  /// Frames processed without masks of their own in real time so far.
  std::size_t without_masks() const { return without_masks_; }

 private:
  void run_serial(SlamSystem& system, const Source& source, const Sink& sink);
  void run_threaded(SlamSystem& system, const Source& source, const Sink& sink);

  AsyncOptions options_;
  std::atomic<std::size_t> dropped_ = 0;        // counted by the reading thread
  std::atomic<std::size_t> without_masks_ = 0;  // counted by the segmenting thread
};

}  // namespace mms
