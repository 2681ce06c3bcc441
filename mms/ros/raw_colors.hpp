#pragma once

#include <cstddef>
#include <string>

#include "mms/core/image.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

/// Bytes of a pixel of an encoding of color as sensors send it, 0 for others: yuv422 (also called
/// uyvy), yuv422_yuy2 (also yuyv), and bayer_rggb8, bayer_bggr8, bayer_gbrg8, bayer_grbg8.
std::size_t raw_color_size(const std::string& encoding);

/// Color of an image in such an encoding. Of Bayer patterns, each pixel has the means of the
/// nearest samples of the colors that it lacks.
/// @param message  with all its rows
/// @throws DataError at `where` for sides that the encoding does not allow.
Image<Rgb> raw_color_of(const msg::Image& message, const std::string& where);

}  // namespace mms
