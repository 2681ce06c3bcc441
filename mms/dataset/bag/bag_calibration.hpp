#pragma once

#include <filesystem>

#include "mms/dataset/bag/bag_recording.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// The calibration of a bag whose frames are known: NAME.calibration.yaml beside NAME.bag, or else
/// the camera of a camera_info topic, and T_camera_lidar by the bag's transforms. Says which in the
/// recording's facts.
/// @param camera_info  topic; empty where there is none
/// @throws DataError when there are images, but no camera for them; ConfigError for a faulty file.
Calibration bag_calibration(BagRecording& recording, const std::string& camera_info,
                            const TransformTree& transforms, const std::filesystem::path& path);

}  // namespace mms
