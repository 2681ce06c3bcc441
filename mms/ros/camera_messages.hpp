#pragma once

#include <string>

#include "mms/core/calibration.hpp"
#include "mms/ros/messages.hpp"

namespace mms {

/// The camera of a CameraInfo: K with the lens of D (plumb_bob, or rational_polynomial whose last
/// three coefficients are zero), or P without a lens where the images are rectified ones.
/// @throws DataError at `where` for another lens, for one that is not calibrated, and for binning.
CameraIntrinsics intrinsics_of(const msg::CameraInfo& message, bool rectified,
                               const std::string& where);

msg::CameraInfo camera_info_message(const msg::Header& header, const CameraIntrinsics& camera);

}  // namespace mms
