#pragma once

#include <Eigen/Core>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/free_space/cube_pixel.hpp"

namespace mms {

/// What one LiDAR scan views through, sharply enough to take points out of a map: by directions
/// half a degree wide. Between two rings the nearer one counts, so that a floor that both graze is
/// not seen through; and a direction is free only as far as those about it are, all of which have
/// to be known, so that what hangs beside its rays stays.
class ScanSight {
 public:
  /// @param margin  by which a point has to lie behind another, noise included [m]
  ScanSight(const LabeledCloud& cloud, double margin);

  /// True where what was measured is clearly behind `point` (sensor frame [m]).
  bool sees_through(const Eigen::Vector3f& point) const {
    return free_range(point) > point.norm() + margin_;
  }

  /// False where the direction of `center` (sensor frame [m]) is not free into the ball about it,
  /// which is no proof for a ball that is wider than a direction; cheap.
  bool may_see_into(const Eigen::Vector3f& center, float radius) const {
    return free_range(center) > center.norm() - radius + margin_;
  }

 private:
  float free_range(const Eigen::Vector3f& point) const;

  CubeImage<float> free_range_;  // [m], 0 where it is not known
  float margin_;
};

}  // namespace mms
