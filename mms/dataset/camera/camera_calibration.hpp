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

/// Intrinsics of the options, else those of the camera; the depth scale is the camera's.
/// @param what  address or file, for messages
/// @throws DataError for a camera of another size and for a depth scale; as `read_any_calibration`.
CameraCalibration camera_calibration(const CameraDevice& device, const std::string& what,
                                     const CameraOptions& options);

}  // namespace mms
