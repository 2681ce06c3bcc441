#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// The cloud of a LiDAR frame in the LiDAR frame, with colors where the camera sees it: every
/// finite point in range is static, the others are invalid (NaN).
LabeledCloud build_scan_cloud(const Frame& frame, const FusionConfig& config);

/// Mask values of points, see `MaskImage`; zero for points behind the camera or off the image.
struct PointMask {
  std::vector<std::uint16_t> raw;
  std::vector<std::uint16_t> dilated;
};

/// Mask values at the projections of `points`, given in the LiDAR frame; zero for NaN points.
/// @param mask         drawn on blocks of `stride` pixels
/// @param calibration  with a camera
PointMask project_masks(const std::vector<Eigen::Vector3f>& points, const MaskImage& mask,
                        const Calibration& calibration, int stride);

}  // namespace mms
