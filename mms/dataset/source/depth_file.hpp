#pragma once

#include <cstdint>
#include <filesystem>

#include "mms/core/image.hpp"

namespace mms {

/// Reads a depth image in meters, 0 for no return: a 16-bit PNG, TIFF or NumPy file (.npy) in units
/// of 1/scale m, or floating-point numbers in a NumPy file, TIFF, EXR or PFM. Infinite and negative
/// numbers are no returns, too.
/// @param scale        units per meter of a 16-bit image
/// @param invalid      value of a 16-bit image that means no return besides 0
/// @param float_scale  units per meter of floating-point numbers
/// @throws FileError if the file cannot be read; DataError if it is damaged or no such image.
Image<float> read_depth(const std::filesystem::path& path, double scale, std::uint16_t invalid,
                        double float_scale = 1.0);

}  // namespace mms
