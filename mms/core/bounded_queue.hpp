#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mms {

/// Thread-safe queue of at most `capacity` items.
template <class T>
class BoundedQueue {
 public:
  /// @param capacity  at least 1
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Blocks while the queue is full. Returns false and drops the item if the queue is closed.
  bool push(T item) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
    return add(std::move(item));
  }

  /// Does not block: returns false and drops the item if the queue is full or closed.
  bool try_push(T item) {
    const std::scoped_lock lock(mutex_);
    return items_.size() < capacity_ && add(std::move(item));
  }

  /// Blocks until an item is available. Returns nullopt if the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    T item = std::move(items_.front());
    items_.pop_front();
    room_.notify_one();
    return item;
  }

  /// Whether `close` was called.
  bool is_closed() const {
    const std::scoped_lock lock(mutex_);
    return closed_;
  }

  /// Wakes all waiting threads. Items already in the queue can still be popped.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    room_.notify_all();
    filled_.notify_all();
  }

 private:
  bool add(T&& item) {
    if (closed_) return false;
    items_.push_back(std::move(item));
    filled_.notify_one();
    return true;
  }

  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable room_;
  std::condition_variable filled_;
  std::deque<T> items_;
  bool closed_ = false;
};

}  // namespace mms
