#pragma once

#include <optional>
#include <string>

#include "mms/core/transform.hpp"
#include "mms/ros/bag/bag_reader.hpp"

namespace mms {

// Bags of RealSense's SDK and its viewer name their topics by device, sensor and stream. Depth is
// never registered there, all images have the frame "0", and there is no /tf_static. Source:
// librealsense, src/media/ros/ros_file_format.h and ros_writer.cpp.

/// Whether RealSense's SDK recorded an image topic: "/device_0/sensor_0/Depth_0/image/data".
bool is_realsense_stream(const std::string& image_topic);

/// Topic of the camera of such a stream: "/device_0/sensor_0/Depth_0/info/camera_info".
std::string realsense_camera_info(const std::string& image_topic);

/// Units per meter of the depth of such a stream, by the option of its sensor; nullopt if there is
/// none from 0.001 to 1e6.
std::optional<double> realsense_depth_scale(const BagReader& bag, const std::string& depth_topic);

/// Extrinsics of two such streams of one device; nullopt if the bag does not have both.
std::optional<Transform<Camera, Depth>> realsense_extrinsics(const BagReader& bag,
                                                             const std::string& color_topic,
                                                             const std::string& depth_topic);

}  // namespace mms
