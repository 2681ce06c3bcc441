#include "interfaces/ros1/src/mask_exchange.hpp"

#include <algorithm>

namespace mms {
namespace {

constexpr std::size_t kRemembered = 1000;  // unanswered images
constexpr double kSmoothing = 0.1;
constexpr double kMaxWindow = 30.0;
constexpr double kShrink = 0.7;  // factor of the window after late masks
constexpr int kProbes = 6;       // on a silent link, per maximum waiting time of a frame

}  // namespace

bool MaskExchange::may_send() const {
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (may_probe(now)) return true;
  const Clock::time_point given_up = now - 2 * max_wait_;
  const auto under_way = std::count_if(sent_.begin(), sent_.end(),
                                       [&](const auto& image) { return image.second > given_up; });
  return static_cast<double>(under_way) < window_;
}

/// Images lost by an interrupted link fill the window. One answer shows that all earlier ones are
/// lost, so a silent link is probed now and then.
bool MaskExchange::may_probe(Clock::time_point now) const {
  const Clock::duration period = max_wait_ / kProbes;
  return waits_since_ && now - *waits_since_ > 2 * period && now - last_sent_ > period;
}

void MaskExchange::sent(Timestamp stamp) {
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  sent_[stamp] = now;
  if (sent_.size() > kRemembered) sent_.erase(sent_.begin());
  if (!waits_since_) waits_since_ = now;
  last_sent_ = now;
  ++counts_.sent;
}

void MaskExchange::received(Timestamp stamp, Segmentation masks) {
  const std::scoped_lock lock(mutex_);
  const auto sent = sent_.find(stamp);
  if (sent == sent_.end()) return;  // from an earlier run of this node
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const double delay = Milliseconds(Clock::now() - sent->second).count();
  counts_.delay_ms += (counts_.delay_ms == 0.0 ? 1.0 : kSmoothing) * (delay - counts_.delay_ms);
  adapt_window(Clock::now() - sent->second);
  sent_.erase(sent_.begin(), std::next(sent));
  waits_since_.reset();
  if (!sent_.empty()) waits_since_ = Clock::now();
  if (done_ && stamp <= *done_) {
    ++counts_.late;
  } else {
    masks_[stamp] = std::move(masks);
  }
  arrived_.notify_all();
}

/// Additive increase per window of answers, one multiplicative decrease per group of late ones.
void MaskExchange::adapt_window(Clock::duration delay) {
  const Clock::time_point now = Clock::now();
  if (delay <= max_wait_) {
    window_ = std::min(kMaxWindow, window_ + 1.0 / window_);
  } else if (now - last_shrunk_ > delay) {
    window_ = std::max(1.0, kShrink * window_);
    last_shrunk_ = now;
  }
}

bool MaskExchange::link_lost(Clock::time_point now) const {
  return waits_since_ && now - *waits_since_ > link_timeout_;
}

std::optional<Segmentation> MaskExchange::wait_for(Timestamp stamp, std::size_t clock) {
  std::unique_lock lock(mutex_);
  const auto sent = sent_.find(stamp);
  const Clock::time_point deadline =
      (sent == sent_.end() ? Clock::now() : sent->second + max_wait_);
  const auto is_settled = [&] {
    const bool overtaken = !masks_.empty() && masks_.rbegin()->first >= stamp;
    return clock != clock_ || closed_ || overtaken || link_lost(Clock::now());
  };
  arrived_.wait_until(lock, deadline, is_settled);
  if (clock != clock_) return std::nullopt;
  done_ = stamp;
  std::optional<Segmentation> result;
  if (const auto found = masks_.find(stamp); found != masks_.end()) {
    result = std::move(found->second);
    ++counts_.used;
  } else {
    ++counts_.missing;
  }
  masks_.erase(masks_.begin(), masks_.upper_bound(stamp));
  return result;
}

std::size_t MaskExchange::clock() const {
  const std::scoped_lock lock(mutex_);
  return clock_;
}

void MaskExchange::forget() {
  const std::scoped_lock lock(mutex_);
  ++clock_;
  sent_.clear();
  masks_.clear();
  done_.reset();
  waits_since_.reset();
  arrived_.notify_all();
}

void MaskExchange::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  arrived_.notify_all();
}

MaskExchange::Counts MaskExchange::counts() const {
  const std::scoped_lock lock(mutex_);
  Counts counts = counts_;
  counts.window = window_;
  counts.link_lost = link_lost(Clock::now());
  return counts;
}

}  // namespace mms
