#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/global_map/keyframes/keyframe_view.hpp"

namespace mms {

/// The returns of a LiDAR keyframe: the nearest and the farthest one of each direction, about a
/// degree wide. The vectors are parallel.
struct ScanView {
  std::vector<Eigen::Vector3f> points;  ///< in the sensor frame [m]
  std::vector<std::uint8_t> is_static;  ///< non-zero at static points
  /// From the floor's frame: z is up, x the sensor's forward direction along the floor.
  Eigen::Isometry3d T_sensor_floor = Eigen::Isometry3d::Identity();

  /// As a cloud without colors.
  LabeledCloud cloud() const;
};

/// @param cloud  a scan, as if all its points were measured at its stamp
ScanView make_scan_view(const LabeledCloud& cloud);

/// The same as `compare_views`, of scans.
ViewAgreement compare_scans(const ScanView& a, const ScanView& b, const Eigen::Isometry3d& T_a_b);

}  // namespace mms
