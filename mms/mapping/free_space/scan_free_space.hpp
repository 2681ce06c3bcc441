#pragma once

#include <Eigen/Core>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/free_space/cube_pixel.hpp"
#include "mms/mapping/free_space/space_state.hpp"

namespace mms {

/// The space that one LiDAR scan observes as free: in front of its points, static or dynamic. Its
/// directions are the pixels of a cube around the sensor, for any mounting and scan pattern: about
/// a degree wide, or half a degree where the points of a dense scan fill them. A direction is free
/// as far as the nearest point in it and its eight neighbours; in sparse scans some of them have no
/// point.
class ScanFreeSpace {
 public:
  /// @param margin  by which a point has to lie behind another, noise included [m]
  ScanFreeSpace(const LabeledCloud& cloud, double margin);

  /// What was observed at `point` (sensor frame [m]); a surface also between nearer and farther
  /// points, never kNone.
  SpaceState state_at(const Eigen::Vector3f& point) const;

 private:
  /// Of the points in a direction, by their distance [m]; none where `farthest` is 0.
  struct Span {
    float nearest = 0.0F;
    float farthest = 0.0F;

    void extend(float low, float high);
  };

  /// Of each pixel alone, in a cube of side x side pixels a face.
  static CubeImage<Span> spans_of(const LabeledCloud& cloud, int side);
  const Span& span_of(const Eigen::Vector3f& point) const;

  CubeImage<Span> faces_;
  float margin_;
};

}  // namespace mms
