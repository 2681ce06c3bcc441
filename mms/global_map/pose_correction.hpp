#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms {

/// Correction of the odometry's drift over time, interpolated between keyframes.
class PoseCorrection {
 public:
  /// Adds the correction at a keyframe, later than those before.
  void add(Timestamp stamp, const Transform<Global, World>& correction) {
    entries_.push_back({stamp, correction});
  }

  /// The correction of what was measured at `stamp`: that of the nearest keyframe before the first
  /// and after the last one; the identity without any.
  Transform<Global, World> at(Timestamp stamp) const;

  /// Whether it corrects nothing.
  bool empty() const { return entries_.empty(); }

 private:
  struct Entry {
    Timestamp stamp;
    Transform<Global, World> T_global_world;
  };

  std::vector<Entry> entries_;  // by stamp
};

}  // namespace mms
