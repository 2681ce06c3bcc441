#pragma once

#include <string>

#include "mms/core/image.hpp"
#include "mms/ros/ros_messages.hpp"

namespace mms {

/// Color image of an image message: rgb8, bgr8, rgba8, bgra8, mono8, mono16 and OpenCV's 8UC1, 8UC3
/// (treated as bgr8), 8UC4; and those of raw_colors.hpp.
/// @throws DataError at `where` for other encodings, and for a size other than the header's.
Image<Rgb> color_of(const msg::Image& message, const std::string& where);

/// Decodes a JPEG or PNG image.
/// @throws DataError at `where` if it cannot be decoded.
Image<Rgb> color_of(const msg::CompressedImage& message, const std::string& where);

/// Depth in meters, 0 for no return, of a 16UC1 or mono16 image or a 32FC1 image in meters.
/// @param scale  units per meter of 16-bit images; ROS has millimeters
/// @throws DataError at `where` as color_of.
Image<float> depth_of(const msg::Image& message, const std::string& where, double scale = 1000.0);

/// Depth of a PNG or RVL image of compressed_depth_image_transport, after its header of 12 bytes,
/// or of a plain 16-bit PNG.
/// @param scale  units per meter of 16-bit images; not used for inverse depth of 32FC1
/// @throws DataError at `where` if it cannot be decoded.
Image<float> depth_of(const msg::CompressedImage& message, const std::string& where,
                      double scale = 1000.0);

/// Label image (0 static, else 1 + class id) of a mono8 or 8UC1 image.
/// @throws DataError at `where` as color_of.
Image<std::uint8_t> mask_of(const msg::Image& message, const std::string& where);

/// Whether depth_of, or color_of, supports this encoding.
bool is_depth_encoding(const std::string& encoding);
bool is_color_encoding(const std::string& encoding);
/// Whether mask_of supports this encoding.
bool is_mask_encoding(const std::string& encoding);

/// Messages with the given header, in the encodings rgb8, 32FC1, 16UC1 and mono8.
msg::Image image_message(const msg::Header& header, const Image<Rgb>& image);
msg::Image image_message(const msg::Header& header, const Image<float>& depth);
msg::Image image_message(const msg::Header& header, const Image<std::uint16_t>& depth);
msg::Image image_message(const msg::Header& header, const Image<std::uint8_t>& mask);

/// JPEG of a color image, or PNG of depth in millimeters as of compressed_depth_image_transport.
msg::CompressedImage compressed_message(const msg::Header& header, const Image<Rgb>& image,
                                        int quality);
msg::CompressedImage compressed_message(const msg::Header& header,
                                        const Image<std::uint16_t>& depth);

}  // namespace mms
