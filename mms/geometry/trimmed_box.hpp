#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace mms {

/// Axis-aligned box of `points` [m] without the share `trim` (below 0.5) at either end of each
/// axis, which removes outliers. Empty box for no points.
Eigen::AlignedBox3f trimmed_box(const std::vector<Eigen::Vector3f>& points, double trim);

}  // namespace mms
