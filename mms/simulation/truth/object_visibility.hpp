#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/simulation/sensors/exact_view.hpp"
#include "mms/simulation/truth/object_truth.hpp"
#include "mms/simulation/world/stage.hpp"

namespace mms {

/// All actors of the stage at its present time, with bounding boxes and visibility in `view`. Boxes
/// and velocities are in the building's frame; velocity and `moving` are zero, as a stage has no
/// velocities.
std::vector<ObjectTruth> visible_objects(const Stage& stage, const ExactView& view,
                                         const CameraIntrinsics& camera,
                                         const Eigen::Isometry3d& T_building_camera);

/// The label image of a view: 0 static, else 1 + class id.
Image<std::uint8_t> label_image(const Stage& stage, const ExactView& view);

}  // namespace mms
