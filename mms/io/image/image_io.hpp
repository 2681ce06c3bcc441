#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Reads a color or gray image: PNG, JPEG, BMP, WebP or TIFF. Ignores orientation tags: pixels are
/// as recorded.
/// @throws FileError if the file cannot be read; DataError if it is truncated or not an image.
Image<Rgb> read_color(const std::filesystem::path& path);

/// Decodes a file of these formats.
/// @throws DataError at `where` as above.
Image<Rgb> decode_color(std::span<const std::uint8_t> bytes, const std::string& where);

/// A depth image as stored: whole numbers in the file's units, or floating-point numbers.
using StoredDepth = std::variant<Image<std::uint16_t>, Image<float>>;

/// Reads a depth image: a 16-bit PNG or TIFF with one channel, or a floating-point TIFF, EXR or
/// PFM, of which the first channel is taken.
/// @throws FileError, DataError as above, and for 8-bit or color images.
StoredDepth read_stored_depth(const std::filesystem::path& path);

/// Reads a 16-bit depth PNG or TIFF with one channel, in the file's units.
/// @throws FileError, DataError as above, and for all other images.
Image<std::uint16_t> read_depth16(const std::filesystem::path& path);

/// Decodes a 16-bit PNG.
/// @throws DataError at `where` as above.
Image<std::uint16_t> decode_depth16(std::span<const std::uint8_t> bytes, const std::string& where);

/// Reads an 8-bit label PNG with one channel.
/// @throws FileError, DataError as above, and for 16-bit or color images.
Image<std::uint8_t> read_mask(const std::filesystem::path& path);

/// Writes a PNG.
/// @throws FileError if the file cannot be written; DataError for an empty image.
void write_png(const std::filesystem::path& path, const Image<Rgb>& image);
void write_png(const std::filesystem::path& path, const Image<std::uint8_t>& image);
void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& image);

/// Encodes a PNG file.
/// @throws DataError for an empty image.
std::vector<std::uint8_t> encode_png(const Image<Rgb>& image);
std::vector<std::uint8_t> encode_png(const Image<std::uint8_t>& image);
std::vector<std::uint8_t> encode_png(const Image<std::uint16_t>& image);

/// Encodes a JPEG file; `quality` in [0, 100].
/// @throws DataError for an empty image.
std::vector<std::uint8_t> encode_jpeg(const Image<Rgb>& image, int quality = 85);

}  // namespace mms
