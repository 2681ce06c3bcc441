#pragma once

#include <filesystem>

#include "mms/io/image/image_io.hpp"

namespace mms {

/// Reads an image from a NumPy file: an array of two dimensions in C order, of little-endian 32- or
/// 64-bit floating-point numbers, which become 32-bit ones, or 16-bit unsigned integers.
/// @throws FileError if the file cannot be read; DataError if it is truncated or has another array.
StoredDepth read_npy(const std::filesystem::path& path);

}  // namespace mms
