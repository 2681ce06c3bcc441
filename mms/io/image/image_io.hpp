#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Reads a PNG or JPEG picture, grey ones included. Orientation tags are ignored: pixels are what
/// the sensor gave.
/// @throws FileError when the file cannot be read, DataError when it is truncated or no image.
Image<Rgb> read_color(const std::filesystem::path& path);

/// The picture in the bytes of a PNG or JPEG file. @throws DataError at `where` as above.
Image<Rgb> decode_color(std::span<const std::uint8_t> bytes, const std::string& where);

/// Reads a 16-bit depth PNG with one channel, in the file's own units.
/// @throws FileError, DataError as above, and for 8-bit or coloured images.
Image<std::uint16_t> read_depth16(const std::filesystem::path& path);

/// The depth image in the bytes of a 16-bit PNG. @throws DataError at `where` as above.
Image<std::uint16_t> decode_depth16(std::span<const std::uint8_t> bytes, const std::string& where);

/// Reads an 8-bit label PNG with one channel.
/// @throws FileError, DataError as above, and for 16-bit or coloured images.
Image<std::uint8_t> read_mask(const std::filesystem::path& path);

/// Writes a PNG. @throws FileError when the file cannot be written, DataError for an empty image.
void write_png(const std::filesystem::path& path, const Image<Rgb>& image);
void write_png(const std::filesystem::path& path, const Image<std::uint8_t>& image);
void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& image);

/// The bytes of a PNG file. @throws DataError for an empty image.
std::vector<std::uint8_t> encode_png(const Image<Rgb>& image);
std::vector<std::uint8_t> encode_png(const Image<std::uint8_t>& image);
std::vector<std::uint8_t> encode_png(const Image<std::uint16_t>& image);

/// The bytes of a JPEG file; `quality` in [0, 100]. @throws DataError for an empty image.
std::vector<std::uint8_t> encode_jpeg(const Image<Rgb>& image, int quality = 85);

}  // namespace mms
