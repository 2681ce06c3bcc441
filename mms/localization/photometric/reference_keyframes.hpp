#pragma once

#include <vector>

#include "mms/localization/photometric/photometric_term.hpp"

namespace mms {

/// The keyframes of the photometric term. They keep their pose, so a camera that returns to a place
/// is compared with its first view of it and does not drift.
class ReferenceKeyframes {
 public:
  ReferenceKeyframes(const PhotometricConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise) {}

  /// Up to `config.references` keyframes nearest in view to the pose, nearest first. The pointers
  /// are valid until the next `update` or `clear`.
  std::vector<const IntensityKeyframe*> nearest(const Eigen::Isometry3d& T_world_sensor) const;

  /// Makes the frame a keyframe if its pose is farther from all others than the thresholds.
  void update(const std::vector<IntensityLevel>& levels, const Eigen::Isometry3d& T_world_sensor);

  void clear() { keyframes_.clear(); }
  std::size_t size() const { return keyframes_.size(); }

 private:
  /// 1 at the thresholds of parallax or rotation alone.
  double distance(const IntensityKeyframe& keyframe, const Eigen::Isometry3d& pose) const;

  PhotometricConfig config_;
  DepthNoise noise_;
  std::vector<IntensityKeyframe> keyframes_;
};

}  // namespace mms
