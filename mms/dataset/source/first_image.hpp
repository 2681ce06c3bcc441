#pragma once

#include "mms/core/image.hpp"
#include "mms/dataset/source/rgbd_source.hpp"

namespace mms {

/// The first color image of a recording that can be read, for its size.
/// @throws FileError, DataError of the first one if none can.
Image<Rgb> first_color(const RgbdRecording& recording);

/// The first depth image that can be read, as of `read_depth`, for its size.
/// @throws FileError, DataError of the first one if none can.
Image<float> first_depth(const RgbdRecording& recording);

}  // namespace mms
