#pragma once

#include <string>

#include "mms/core/image.hpp"
#include "mms/ros/messages.hpp"

namespace mms {

/// The picture of an image message: rgb8, bgr8, rgba8, bgra8, mono8, mono16 and OpenCV's 8UC1, 8UC3
/// (taken for bgr8), 8UC4. @throws DataError at `where` for other encodings, and for an image that
/// is smaller or larger than its header says.
Image<Rgb> color_of(const msg::Image& message, const std::string& where);

/// The picture of a JPEG or PNG. @throws DataError at `where` when it cannot be decoded.
Image<Rgb> color_of(const msg::CompressedImage& message, const std::string& where);

/// Depth in metres, 0 where there is no return, of a 16UC1 or mono16 image in millimetres or a
/// 32FC1 one in metres. @throws DataError at `where` as color_of does.
Image<float> depth_of(const msg::Image& message, const std::string& where);

/// The same of compressed_depth_image_transport's PNG, behind its header of 12 bytes, or of a plain
/// 16-bit PNG in millimetres. @throws DataError at `where` when it cannot be decoded.
Image<float> depth_of(const msg::CompressedImage& message, const std::string& where);

/// The label image (0 static, else 1 + class id) of a mono8 or 8UC1 image.
/// @throws DataError at `where` as color_of does.
Image<std::uint8_t> mask_of(const msg::Image& message, const std::string& where);

/// Whether depth_of takes images of this encoding, and whether color_of does.
bool is_depth_encoding(const std::string& encoding);
bool is_color_encoding(const std::string& encoding);

/// Messages of the header given, in encodings rgb8, 32FC1, 16UC1 and mono8.
msg::Image image_message(const msg::Header& header, const Image<Rgb>& image);
msg::Image image_message(const msg::Header& header, const Image<float>& depth);
msg::Image image_message(const msg::Header& header, const Image<std::uint16_t>& depth);
msg::Image image_message(const msg::Header& header, const Image<std::uint8_t>& mask);

/// JPEG of a picture, and compressed_depth_image_transport's PNG of depth in millimetres.
msg::CompressedImage compressed_message(const msg::Header& header, const Image<Rgb>& image,
                                        int quality);
msg::CompressedImage compressed_message(const msg::Header& header,
                                        const Image<std::uint16_t>& depth);

}  // namespace mms
