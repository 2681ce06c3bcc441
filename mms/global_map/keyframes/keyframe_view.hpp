#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/depth_noise.hpp"

namespace mms {

/// Small depth image of a keyframe.
struct KeyframeView {
  CameraIntrinsics camera;        ///< of the image
  Image<std::uint16_t> depth_mm;  ///< 0 without a return
  Image<std::uint8_t> is_static;  ///< non-zero at static points

  /// As a cloud without colors.
  LabeledCloud cloud() const;
};

/// @param cloud  organized
KeyframeView make_keyframe_view(const LabeledCloud& cloud);

/// How the static points of one view agree with the depth of another.
struct ViewAgreement {
  double overlap = 0.0;  ///< share of all points that are on surfaces that the other one measured
  double contradiction = 0.0;  ///< share in free space, of the points that the other one can see
};

/// @param T_a_b  from the sensor frame of `b` to that of `a`
/// @returns the agreement of the points of `b` with the depth of `a`
ViewAgreement compare_views(const KeyframeView& a, const KeyframeView& b,
                            const Eigen::Isometry3d& T_a_b, const DepthNoise& noise);

}  // namespace mms
