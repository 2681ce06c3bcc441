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

  explicit FrameQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(Frame frame) {
    const std::scoped_lock lock(mutex_);
    if (closed_ || ended_) return;  // nobody takes it
    frames_.push_back({std::move(frame), Clock::now()});
    if (frames_.size() > capacity_) drop_oldest();
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
    Arrived next = std::move(frames_.front());
    frames_.pop_front();
    arrival_ = next.at;
    return std::move(next.frame);
  }

  /// Clears the queue and makes one `pop` return nullopt.
  void interrupt() {
    const std::scoped_lock lock(mutex_);
    frames_.clear();
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

  void drop_oldest() {
    LeftOutFrames left_out;
    left_out.add(frames_.front().frame);
    frames_.pop_front();
    if (!frames_.empty()) left_out.give_to(frames_.front().frame);
    ++dropped_;
  }

  std::size_t capacity_;
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
