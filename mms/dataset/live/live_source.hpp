#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mms/dataset/live/frame_queue.hpp"
#include "mms/dataset/source/frame_source.hpp"
#include "mms/geometry/depth_registration.hpp"

namespace mms {

/// Common part of sensors whose frames arrive in a thread of their own. When the queue is full, the
/// oldest frame is dropped; the first time there is a warning. Depth images with a `depth_camera`
/// are registered when the run takes them.
class LiveSource : public FrameSource {
 public:
  /// Waits for the first frame, with which the calibration is known.
  /// @param report  receives warnings until then, as of what is missing
  /// @returns false if the source ended before
  bool wait(WarningHandler report);

  /// The next frame, for which it waits; nullopt at the end.
  std::optional<Frame> next() override;
  std::size_t size() const override { return kEndless; }
  std::size_t skipped() const override { return 0; }
  void skip(std::size_t count) override;
  std::size_t dropped() const override { return queue_.dropped(); }
  std::optional<std::chrono::steady_clock::time_point> arrival() const override {
    return queue_.arrival();
  }
  bool has_masks() const override { return false; }
  std::shared_ptr<const Calibration> calibration() const override { return calibration_; }
  const Trajectory& ground_truth() const override { return no_truth_; }
  void add_motion(MotionRecording) override {}
  void on_warning(WarningHandler handler) override;

  /// Passes a line to the warning handler, or to the next one while there is none; in any thread.
  void warn(const std::string& message);

 protected:
  /// @param capacity  frames that may wait
  explicit LiveSource(std::size_t capacity) : queue_(capacity) {}

  // In the thread of the sensor:

  void push(Frame frame);
  /// No frame follows those that wait.
  void end() { queue_.end(); }
  /// Ends without them.
  void close() { queue_.close(); }

 private:
  void register_depth(Frame& frame);

  FrameQueue queue_;
  Trajectory no_truth_;
  bool said_dropped_ = false;  // of the thread of the sensor

  // Of the thread of the run:
  std::optional<Frame> first_;
  std::shared_ptr<const Calibration> calibration_;
  std::shared_ptr<const Calibration> raw_calibration_;  ///< of `registration_`
  std::optional<DepthRegistration> registration_;

  std::mutex handler_mutex_;  ///< guards all below
  WarningHandler handler_;
  std::vector<std::string> unheard_;  ///< warnings for the next handler
};

}  // namespace mms
