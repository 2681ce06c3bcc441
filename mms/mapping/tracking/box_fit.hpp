#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "mms/mapping/ground/ground_frame.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"

namespace mms {

/// Center and extent of a box with a given heading, estimated from one measurement. Axes are those
/// of the box: length, width, height.
struct BoxFit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< world frame [m]
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< of the measured points [m]
  std::array<bool, 3> whole{};                       ///< whether both ends were in view
  bool anchored = true;  ///< false when along some axis neither end was in view
};

/// Fits a box to the visible side of an object. Along an axis with both ends in view the center is
/// that of the points; else the box is anchored at one end and the other follows from the known
/// size, so that hidden, truncated or averted parts do not shift the box. The far end of an axis is
/// in view where a face along it is visible. Points that cover much less than the known size are
/// anchored at the end nearer to its expected position: a part of the object gives no returns.
/// Where the floor is known, objects stand on it.
/// @param heading   of the box's length [rad]
/// @param size      length, width, height as estimated so far [m]
/// @param expected  position of the center (world frame [m]); nothing for a new object
BoxFit fit_box(const ObjectMeasurement& object, const GroundFrame& ground, double heading,
               const Eigen::Vector3d& size, const std::optional<Eigen::Vector3d>& expected = {});

/// Heading [rad, in [0, pi/2)] of the rectangle whose sides are closest to the points, seen from
/// above (closeness criterion, Zhang et al., IV 2017).
double rectangle_heading(const ObjectMeasurement& object, const GroundFrame& ground);

}  // namespace mms
