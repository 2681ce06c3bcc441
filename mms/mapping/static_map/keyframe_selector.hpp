#pragma once

#include <optional>

#include "mms/core/config_visitor.hpp"
#include "mms/core/odometry_estimate.hpp"

namespace mms {

struct KeyframeConfig {
  double translation = 0.10;  ///< [m]
  double rotation = 5.0;      ///< [deg]
  double max_interval = 0.2;  ///< [s]

  void visit(ConfigVisitor& v) {
    v.number({"translation", "m", "translation that makes a keyframe"}, translation, {0.0, 100.0});
    v.number({"rotation", "deg", "rotation that makes a keyframe"}, rotation, {0.0, 180.0});
    v.number({"max_interval", "s", "longest time without a keyframe"}, max_interval, {0.0, 3600.0});
  }
};

/// Chooses the frames that update the maps (III-C.4): those that moved or turned far enough since
/// the last one. Beyond the paper, also after `max_interval`, so that a camera at rest maps the
/// places that people uncover. A lost frame is never a keyframe: its pose is only a prediction.
class KeyframeSelector {
 public:
  explicit KeyframeSelector(const KeyframeConfig& config = {}) : config_(config) {}

  /// Decides on the next frame; one that is chosen becomes the reference for those that follow.
  bool is_keyframe(const OdometryEstimate& odometry);

 private:
  bool far_from_last(const OdometryEstimate& odometry) const;

  KeyframeConfig config_;
  std::optional<OdometryEstimate> last_;
};

}  // namespace mms
