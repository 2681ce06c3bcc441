#include "mms/pipeline/correction_feed.hpp"

#include <chrono>

namespace mms {
namespace {

/// [s]: time after a keyframe at which its correction takes effect. Source: loop closure takes
/// 0.03 s a keyframe, the pose graph of 1,000 keyframes ten times that.
constexpr Duration kCorrectionDelay = std::chrono::milliseconds(500);

}  // namespace

const MapCorrection& CorrectionFeed::at(Timestamp frame) {
  const auto may_take = [&](const Coming& next) {
    return waits_ ? frame - next.keyframe >= kCorrectionDelay
                  : next.result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!coming_.empty() && may_take(coming_.front())) {
    current_ = coming_.front().result.get();
    coming_.pop_front();
  }
  return current_;
}

}  // namespace mms
