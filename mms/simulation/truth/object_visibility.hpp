#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/simulation/sensors/exact_view.hpp"
#include "mms/simulation/truth/object_truth.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {

/// Every actor of the stage, as it is set now, with its tight box and how much of it the camera
/// that took `view` sees. Boxes and velocities are in the building's frame; velocity and `moving`
/// are left at zero, as a stage knows no motion.
std::vector<ObjectTruth> visible_objects(const Stage& stage, const ExactView& view,
                                         const CameraIntrinsics& camera,
                                         const Eigen::Isometry3d& T_building_camera);

/// The label image of a view: 0 static, else 1 + class id.
Image<std::uint8_t> label_image(const Stage& stage, const ExactView& view);

}  // namespace mms
