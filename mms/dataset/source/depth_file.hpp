#pragma once

#include <cstdint>
#include <filesystem>

#include "mms/core/image.hpp"

namespace mms {

/// Reads a depth image in meters, 0 for no return: a 16-bit PNG or TIFF in units of 1/scale m, or
/// numbers in meters in a NumPy file (.npy) or a floating-point TIFF, EXR or PFM. Infinite and
/// negative numbers are no returns, too.
/// @param scale    units per meter of a 16-bit image
/// @param invalid  value of a 16-bit image that means no return besides 0
/// @throws FileError if the file cannot be read; DataError if it is damaged or no such image.
Image<float> read_depth(const std::filesystem::path& path, double scale, std::uint16_t invalid);

}  // namespace mms
