#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>

#include "mms/core/segmentation.hpp"
#include "mms/core/time.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Masks from another host. Images are sent as they arrive; each frame then waits for its masks, at
/// most `max_wait` after its image was sent, and not at all once masks of a later frame have
/// arrived (its own were lost) or the link is lost. The waiting times of consecutive frames
/// overlap, so a slow link adds latency, but drops no frames.
class MaskExchange {
 public:
  using Clock = std::chrono::steady_clock;

  struct Counts {
    std::size_t sent = 0;
    std::size_t used = 0;     ///< fused with their frame
    std::size_t late = 0;     ///< received after their frame was processed
    std::size_t missing = 0;  ///< frames processed without masks
    double window = 0.0;      ///< allowed unanswered images
    double delay_ms = 0.0;    ///< between sending and receiving, recent average
    bool link_lost = false;
  };

  /// @param max_wait      waiting time of a frame for its masks
  /// @param link_timeout  time without masks until the link counts as lost
  MaskExchange(Clock::duration max_wait, Clock::duration link_timeout)
      : max_wait_(max_wait), link_timeout_(link_timeout) {}

  /// Whether the window allows another image, or a silent link should be probed.
  bool may_send() const;

  void sent(Timestamp stamp);
  void received(Timestamp stamp, Segmentation masks);

  /// The masks of a frame; nullopt if they did not arrive in time.
  /// @param clock  number of the clock of the stamp
  std::optional<Segmentation> wait_for(Timestamp stamp, std::size_t clock = 0);

  /// Forgets all images and masks: stamps of another clock follow, and no frame waits for masks of
  /// the clock before.
  void forget();

  /// Number of the present clock.
  std::size_t clock() const;

  /// Makes all waiting threads continue without masks.
  void close();

  Counts counts() const;

 private:
  bool may_probe(Clock::time_point now) const;
  bool link_lost(Clock::time_point now) const;
  void adapt_window(Clock::duration delay);

  Clock::duration max_wait_;
  Clock::duration link_timeout_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<Timestamp, Clock::time_point> sent_;
  std::map<Timestamp, Segmentation> masks_;
  std::optional<Timestamp> done_;  ///< last processed frame
  std::optional<Clock::time_point>
      waits_since_;  ///< time of sending of the oldest unanswered image
  Clock::time_point last_sent_;
  double window_ = 16.0;  ///< allowed unanswered images
  Clock::time_point last_shrunk_;
  Counts counts_;
  bool closed_ = false;
  std::size_t clock_ = 0;
};

/// Passes the masks of another host to the pipeline; an empty segmentation (0x0) if they did not
/// arrive.
class RemoteSegmenter final : public Segmenter {
 public:
  explicit RemoteSegmenter(MaskExchange& exchange)
      : exchange_(exchange), clock_(exchange.clock()) {}

  Segmentation segment(const Frame& frame) override {
    return exchange_.wait_for(frame.stamp, clock_).value_or(Segmentation());
  }

 private:
  MaskExchange& exchange_;
  std::size_t clock_;  ///< of the frames
};

}  // namespace mms
