#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "mms/core/frame.hpp"
#include "mms/core/left_out_frames.hpp"

namespace mms {

/// Queue of frames from the subscribers to the pipeline. When it is full, the oldest frame is
/// dropped: a robot needs its present pose. The next one gets its motion samples and place.
class FrameQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// [B]: largest size of the frames that wait. Source: 100 frames of 640x480 pixels have 205 MiB;
  /// those of large images would fill a computer with 2 GB.
  static constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;

  /// @param capacity   frames that may wait
  /// @param max_bytes  of them together; one frame may have more
  explicit FrameQueue(std::size_t capacity, std::size_t max_bytes = kMaxBytes)
      : capacity_(capacity), max_bytes_(max_bytes) {}

  void push(Frame frame) {
    const std::scoped_lock lock(mutex_);
    if (closed_ || ended_) return;  // nobody takes it
    bytes_ += bytes_of(frame);
    frames_.push_back({std::move(frame), Clock::now()});
    while (frames_.size() > capacity_ || (bytes_ > max_bytes_ && frames_.size() > 1)) drop_oldest();
    filled_.notify_one();
  }

  /// Waits for a frame; nullopt once after `interrupt`, always after `close`, and after `end` when
  /// the queue is empty.
  std::optional<Frame> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return closed_ || ended_ || interrupted_ || !frames_.empty(); });
    if (closed_ || interrupted_ || frames_.empty()) {
      interrupted_ = false;
      return std::nullopt;
    }
    bytes_ -= bytes_of(frames_.front().frame);
    Arrived next = std::move(frames_.front());
    frames_.pop_front();
    arrival_ = next.at;
    return std::move(next.frame);
  }

  /// Clears the queue and makes one `pop` return nullopt.
  void interrupt() {
    const std::scoped_lock lock(mutex_);
    frames_.clear();
    bytes_ = 0;
    interrupted_ = true;
    filled_.notify_all();
  }

  /// No frame follows those that wait.
  void end() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    filled_.notify_all();
  }

  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    filled_.notify_all();
  }

  std::size_t dropped() const {
    const std::scoped_lock lock(mutex_);
    return dropped_;
  }

  /// When the last popped frame was pushed; nullopt before the first one.
  std::optional<Clock::time_point> arrival() const {
    const std::scoped_lock lock(mutex_);
    return arrival_;
  }

 private:
  struct Arrived {
    Frame frame;
    Clock::time_point at;
  };

  /// Size of images and scan, which do not change while the frame waits.
  static std::size_t bytes_of(const Frame& frame) {
    const LidarScan& scan = frame.scan;
    return frame.color.pixels().size() * sizeof(Rgb) + frame.mask.pixels().size() +
           frame.depth.pixels().size() * sizeof(float) +
           scan.points.size() * sizeof(Eigen::Vector3f) +
           (scan.intensity.size() + scan.time_offset.size()) * sizeof(float);
  }

  void drop_oldest() {
    LeftOutFrames left_out;
    bytes_ -= bytes_of(frames_.front().frame);
    left_out.add(frames_.front().frame);
    frames_.pop_front();
    if (!frames_.empty()) left_out.give_to(frames_.front().frame);
    ++dropped_;
  }

  std::size_t capacity_;
  std::size_t max_bytes_;
  std::size_t bytes_ = 0;  ///< of the frames that wait
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<Arrived> frames_;
  std::optional<Clock::time_point> arrival_;
  std::size_t dropped_ = 0;
  bool interrupted_ = false;
  bool ended_ = false;
  bool closed_ = false;
};

}  // namespace mms
