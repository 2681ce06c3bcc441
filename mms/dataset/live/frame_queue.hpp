#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "mms/core/frame.hpp"

namespace mms {

/// Queue of frames from the subscribers to the pipeline. When it is full, the oldest frame is
/// dropped: a robot needs its present pose.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(Frame frame) {
    const std::scoped_lock lock(mutex_);
    frames_.push_back(std::move(frame));
    if (frames_.size() > capacity_) {
      frames_.pop_front();
      ++dropped_;
    }
    filled_.notify_one();
  }

  /// Waits for a frame; nullopt once after `interrupt`, and always after `close`.
  std::optional<Frame> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return closed_ || interrupted_ || !frames_.empty(); });
    if (closed_ || interrupted_) {
      interrupted_ = false;
      return std::nullopt;
    }
    Frame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }

  /// Clears the queue and makes one `pop` return nullopt.
  void interrupt() {
    const std::scoped_lock lock(mutex_);
    frames_.clear();
    interrupted_ = true;
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

 private:
  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<Frame> frames_;
  std::size_t dropped_ = 0;
  bool interrupted_ = false;
  bool closed_ = false;
};

}  // namespace mms
