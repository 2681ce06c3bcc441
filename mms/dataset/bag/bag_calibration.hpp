#pragma once

#include <filesystem>

#include "mms/dataset/bag/bag_recording.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// Calibration of a bag: the given file, else NAME.calibration.yaml next to NAME.bag or
/// calibration.yaml in a folder, in any format of `read_any_calibration`; else the camera of a
/// camera_info topic and extrinsics of the bag's transforms. The depth scale is the given one, else
/// that of the file, of the depth sensor's option in bags of RealSense's SDK, or 1000. Adds the
/// origin to the recording's facts. Images beside clouds are removed from the recording, with a
/// warning, if their camera is not known and no option asks for them.
/// @param topics   camera_info, wheels and imu are used; empty for none
/// @param options  camera, topics and masks are used
/// @throws DataError if there are images without a camera; ConfigError for an invalid file.
Calibration bag_calibration(BagRecording& recording, const BagTopicNames& topics,
                            const TransformTree& transforms, const std::filesystem::path& path,
                            const SourceOptions& options);

}  // namespace mms
