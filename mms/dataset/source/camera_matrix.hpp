#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "mms/core/calibration.hpp"

namespace mms {

/// The camera of the numbers of a 3x3 or 4x4 camera matrix, row-major; without distortion.
/// @throws DataError at `where` for another count of numbers.
CameraIntrinsics camera_of_matrix(std::span<const double> numbers, int width, int height,
                                  const std::string& where);

/// The same from a text file.
/// @throws FileError if it cannot be read; DataError for another content.
CameraIntrinsics read_camera_matrix(const std::filesystem::path& file, int width, int height);

}  // namespace mms
