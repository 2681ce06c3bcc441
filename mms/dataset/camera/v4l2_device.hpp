#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/camera/camera_device.hpp"

namespace mms {

/// Begin of the addresses of V4L2's cameras.
inline constexpr std::string_view kV4l2Address = "camera:v4l2";

/// All cameras that V4L2 finds, also those without depth images.
std::vector<CameraInfo> list_v4l2_cameras();

/// Opens a camera of V4L2: its node of depth images (Z16), and its node of colors (YUYV or MJPG).
/// @param which  index, bus or file (/dev/video0); empty: the first one with depth images
/// @param given  the sizes of its images and the depth scale; without `depth_camera` the depth
/// images are taken as registered
/// @throws DataError as `open_camera`.
std::unique_ptr<CameraDevice> open_v4l2_camera(const std::string& address, const std::string& which,
                                               const Calibration& given);

}  // namespace mms
