#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/depth_noise.hpp"

namespace mms {

/// Small depth image of a keyframe, and a grey image below it.
struct KeyframeView {
  CameraIntrinsics camera;        ///< of the image
  Image<std::uint16_t> depth_mm;  ///< 0 without a return
  Image<std::uint8_t> is_static;  ///< non-zero at static points
  Image<std::uint8_t> gray;       ///< grey values; empty without an image

  /// As a cloud without colors.
  LabeledCloud cloud() const;
};

/// @param color  image of the frame; may be empty
/// @param cloud  organized; its grid covers the image
KeyframeView make_keyframe_view(const Image<Rgb>& color, const LabeledCloud& cloud);

/// How the static points of one view agree with the depth of another.
struct ViewAgreement {
  double overlap = 0.0;  ///< share of all points that are on surfaces that the other one measured
  double contradiction = 0.0;  ///< share in free space, of the points that the other one can see
};

/// @param all            static points of a view
/// @param on_surface     of these, on surfaces that the other view measured
/// @param in_free_space  of these, where the other view measured free space
ViewAgreement agreement_of(std::size_t all, std::size_t on_surface, std::size_t in_free_space);

/// @param T_a_b  from the sensor frame of `b` to that of `a`
/// @returns the agreement of the points of `b` with the depth of `a`
ViewAgreement compare_views(const KeyframeView& a, const KeyframeView& b,
                            const Eigen::Isometry3d& T_a_b, const DepthNoise& noise);

}  // namespace mms
