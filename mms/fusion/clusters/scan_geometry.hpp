#pragma once

#include <vector>

#include "mms/core/frame.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/clouds/scan_cloud.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// III-B.2 for an unorganised cloud in the LiDAR frame: downsamples it by a voxel grid, removes
/// the ground and large planes, finds the dynamic clusters and relabels `cloud` by them.
/// @param covering  mask values of the cloud's points
void fuse_scan_geometry(const MaskImage& mask, const PointMask& covering,
                        const std::vector<Instance>& instances, const Calibration& calibration,
                        const FusionConfig& config, LabeledCloud& cloud);

}  // namespace mms
