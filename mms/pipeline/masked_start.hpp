#pragma once

#include <optional>

#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/localization/odometry.hpp"

namespace mms {

/// The first seconds of a session whose first frame is mostly under masks (beyond the paper).
/// Nothing tells then whether people cover the view, or a network takes the scene for people. The
/// pose ignores such masks; a second odometry follows them, as if nothing else was seen. As soon as
/// both disagree, the points beside the masks tell which one is right: they fit to the first frame
/// at the right pose alone.
class MaskedStart {
 public:
  /// @param before  the odometry before the first frame
  explicit MaskedStart(const Odometry& before) : following_(before) {}

  /// The odometry that follows the masks.
  Odometry& following() { return following_; }

  enum class Verdict { kOpen, kMasksAreRight, kMasksAreWrong };

  /// Adds the next frame.
  /// @param features  of the points beside the masks
  /// @param ignoring  estimate of the odometry that ignores masks which may be wrong
  Verdict add(FeatureCloud features, const OdometryEstimate& ignoring);

  /// Estimate of the last frame by `following`.
  const OdometryEstimate& estimate() const { return estimate_; }

 private:
  Odometry following_;
  std::optional<Odometry> first_;  ///< `following_` after the first frame
  OdometryEstimate estimate_;
  Timestamp begin_;
};

}  // namespace mms
