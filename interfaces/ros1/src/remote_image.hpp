#pragma once

#include "mms/core/image.hpp"
#include "mms/ros/messages.hpp"

namespace mms {

/// The JPEG of an image for another host, made smaller to at most `width`.
msg::CompressedImage remote_image(const msg::Header& header, const Image<Rgb>& image, int width,
                                  int quality);

}  // namespace mms
