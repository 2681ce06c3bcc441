#pragma once

#include <optional>

#include "mms/core/time.hpp"

namespace mms {

/// Decides in real time which frames get masks of their own: all while the network keeps up, else
/// as many as keep the masks young enough.
class MaskPolicy {
 public:
  /// @param max_age  [s]; 0: every frame gets masks
  explicit MaskPolicy(double max_age) : max_age_(max_age) {}

  /// @param had_to_wait  whether the frame came while the network was at work
  bool wants_masks(Timestamp stamp, bool had_to_wait) {
    const bool are_young = last_ && to_seconds(stamp - *last_) < max_age_;
    if (had_to_wait && are_young) return false;
    last_ = stamp;
    return true;
  }

 private:
  double max_age_;
  std::optional<Timestamp> last_;
};

}  // namespace mms
