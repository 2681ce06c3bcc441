#pragma once

#include <string>

#include "mms/core/calibration.hpp"
#include "mms/dataset/camera/camera_device.hpp"
#include "mms/dataset/source/camera_options.hpp"

namespace mms {

/// Calibration of a camera's images, and where it is from.
struct CameraCalibration {
  Calibration calibration;
  std::string origin;  ///< "intrinsics from its field of view: fx 588.3 ..."
};

/// Calibration of the options; without `camera` if they have none.
/// @throws DataError as `read_any_calibration`, and for a file without a camera.
Calibration given_calibration(const CameraOptions& options);

/// Intrinsics that are given, else those of the camera; the depth scale is the camera's, if it
/// tells one.
/// @param what   address or file, for messages
/// @param given  of `given_calibration(options)`
/// @throws DataError for a camera of another size, and for the depth scale of a camera that tells
/// its own.
CameraCalibration camera_calibration(const CameraDevice& device, const std::string& what,
                                     const CameraOptions& options, const Calibration& given);

}  // namespace mms
