#pragma once

#include "mms/core/image.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

/// Encodes an image for another host as JPEG, downsampled to at most `width`.
msg::CompressedImage remote_image(const msg::Header& header, const Image<Rgb>& image, int width,
                                  int quality);

}  // namespace mms
