#pragma once

#include <filesystem>

#include "mms/dataset/bag/bag_recording.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// Calibration of a bag: the given file, else NAME.calibration.yaml next to NAME.bag or
/// calibration.yaml in a folder, else the camera of a camera_info topic and extrinsics of the
/// bag's transforms. Adds the origin to the recording's facts.
/// @param topics  camera_info, wheels and imu are used; empty for none
/// @param given   calibration file; empty for none
/// @throws DataError if there are images without a camera; ConfigError for an invalid file.
Calibration bag_calibration(BagRecording& recording, const BagTopicNames& topics,
                            const TransformTree& transforms, const std::filesystem::path& path,
                            const std::filesystem::path& given);

}  // namespace mms
