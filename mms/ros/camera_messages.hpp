#pragma once

#include <string>

#include "mms/core/calibration.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

/// Camera of a CameraInfo: K with the distortion D (plumb_bob, "Brown Conrady" and "Inverse Brown
/// Conrady" of RealSense's SDK, or rational_polynomial with zeros as last three coefficients), or P
/// without distortion for rectified images.
/// @throws DataError at `where` for other distortion models, for missing calibration, and for
/// binning.
CameraIntrinsics intrinsics_of(const msg::CameraInfo& message, bool rectified,
                               const std::string& where);

/// Whether images of a topic are rectified, by the names of image_proc and of drivers.
bool is_named_rectified(const std::string& topic);

msg::CameraInfo camera_info_message(const msg::Header& header, const CameraIntrinsics& camera);

}  // namespace mms
