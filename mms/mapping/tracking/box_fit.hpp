#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "mms/mapping/ground/ground_frame.hpp"
#include "mms/mapping/tracking/object_measurement.hpp"

namespace mms {

/// What a measurement says about the center and the size of a box with a given heading, along the
/// box's axes: length, width, height.
struct BoxFit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< world frame [m]
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< of the measured points [m]
  std::array<bool, 3> whole{};                       ///< whether both ends were in view
  bool anchored = true;  ///< false when along some axis neither end was in view
};

/// Fits a box to the visible side of an object. Along an axis with both ends in view the center is
/// that of the points; else one end holds and the other follows from the size known, so that what
/// is hidden, truncation off or turned away does not pull the box. The far end of an axis is in
/// view where the sensor looks at a face along it. Points that fill much less than the size known
/// hold to the end that is nearer to where it is expected: a part of the object gives no returns.
/// Where the floor is known, objects stand on it.
/// @param heading   of the box's length [rad]
/// @param size      length, width, height as known so far [m]
/// @param expected  where the center is expected (world frame [m]); nothing for a new object
BoxFit fit_box(const ObjectMeasurement& object, const GroundFrame& ground, double heading,
               const Eigen::Vector3d& size, const std::optional<Eigen::Vector3d>& expected = {});

/// Heading, within a quarter of a turn, of the rectangle whose sides the points seen from above lie
/// nearest to (closeness, Zhang et al., IV 2017) [rad, in [0, pi/2)].
double rectangle_heading(const ObjectMeasurement& object, const GroundFrame& ground);

}  // namespace mms
