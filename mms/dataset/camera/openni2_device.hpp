#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/camera/camera_device.hpp"

namespace mms {

/// Begin of the addresses of OpenNI2's cameras.
inline constexpr std::string_view kOpenNi2Address = "camera:openni2";

/// All cameras that OpenNI2 finds.
/// @throws DataError if OpenNI2 cannot start, or the program was built without it.
std::vector<CameraInfo> list_openni2_cameras();

/// Opens a camera of OpenNI2: 640x480 pixels, depth registered to color.
/// @param which  index or URI; empty: the first one
/// @throws DataError as `open_camera`.
std::unique_ptr<CameraDevice> open_openni2_camera(const std::string& address,
                                                  const std::string& which);

/// Opens a recording of OpenNI2, x.oni, which is read image by image.
/// @throws DataError as `open_camera`.
std::unique_ptr<CameraDevice> open_oni(const std::filesystem::path& path);

}  // namespace mms
