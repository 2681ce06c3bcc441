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

/// Masks on their way back from another host. Images are sent as they arrive; each frame then waits
/// for its own masks, not longer than `max_wait` after its image was sent, and not at all once
/// masks of a later frame have come (its own were lost) or the link is lost. As the waits of
/// successive frames overlap, a delayed link costs latency, but no frames.
class MaskExchange {
 public:
  using Clock = std::chrono::steady_clock;

  struct Counts {
    std::size_t sent = 0;
    std::size_t used = 0;     ///< fused with the frame they belong to
    std::size_t late = 0;     ///< came after their frame was done
    std::size_t missing = 0;  ///< frames that were done without
    double window = 0.0;      ///< images that may be under way
    double delay_ms = 0.0;    ///< from sending to receiving, of the last ones
    bool link_lost = false;
  };

  /// @param max_wait      of a frame for its masks
  /// @param link_timeout  without any masks after which the link counts as lost
  MaskExchange(Clock::duration max_wait, Clock::duration link_timeout)
      : max_wait_(max_wait), link_timeout_(link_timeout) {}

  /// Whether there is room on the link for one more image, or whether to try a link that has been
  /// silent for long.
  bool may_send() const;

  void sent(Timestamp stamp);
  void received(Timestamp stamp, Segmentation masks);

  /// The masks of a frame; nothing where they did not come in time.
  std::optional<Segmentation> wait_for(Timestamp stamp);

  /// Lets every waiting thread go on without masks.
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
  std::optional<Timestamp> done_;                 ///< the last frame asked for
  std::optional<Clock::time_point> waits_since_;  ///< when the oldest unanswered image was sent
  Clock::time_point last_sent_;
  double window_ = 16.0;  ///< images that may be under way
  Clock::time_point last_shrunk_;
  Counts counts_;
  bool closed_ = false;
};

/// Gives the pipeline the masks of another host; none (of size 0x0) where they did not come.
class RemoteSegmenter final : public Segmenter {
 public:
  explicit RemoteSegmenter(MaskExchange& exchange) : exchange_(exchange) {}

  Segmentation segment(const Frame& frame) override {
    return exchange_.wait_for(frame.stamp).value_or(Segmentation());
  }

 private:
  MaskExchange& exchange_;
};

}  // namespace mms
