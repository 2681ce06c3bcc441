#pragma once

#include <Eigen/Core>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/free_space/cube_pixel.hpp"

namespace mms {

/// The space that one LiDAR scan observes as free, precise enough to remove points from a map:
/// directions are a quarter of a degree wide, or half a degree for sparse scans. Between two rings
/// the nearer one counts, so that a floor at a grazing angle is not carved. A direction is free
/// only as far as its eight neighbours, all of which have to be known, so that objects beside its
/// rays stay.
class ScanSight {
 public:
  /// @param margin  by which a point has to lie behind another, noise included [m]
  ScanSight(const LabeledCloud& cloud, double margin);

  /// True where the measured surface is clearly behind `point` (sensor frame [m]).
  bool sees_through(const Eigen::Vector3f& point) const {
    return free_range(point) > point.norm() + margin_;
  }

  /// False where no point of the ball (sensor frame [m]) can be seen through; cheap.
  bool may_see_into(const Eigen::Vector3f& center, float radius) const;

 private:
  float free_range(const Eigen::Vector3f& point) const;

  CubeImage<float> free_range_;  // [m], 0 where it is not known
  CubeImage<float> farthest_;    // of `free_range_` in tiles
  float farthest_of_all_ = 0.0F;
  float margin_;
};

}  // namespace mms
