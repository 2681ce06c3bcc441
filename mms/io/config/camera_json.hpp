#pragma once

#include <filesystem>

#include "mms/core/calibration.hpp"

namespace mms {

/// Reads a camera without distortion from a JSON file: that of Open3D (`width`, `height`,
/// `intrinsic_matrix` of nine numbers, column by column) with an optional `depth_scale` as its
/// recorders write it, or that of NICE-SLAM (`camera` with `w`, `h`, `fx`, `fy`, `cx`, `cy`,
/// `scale`).
/// @returns depth_scale is 1000 units per meter where the file has none
/// @throws FileError if the file cannot be read; DataError with the key for other content.
Calibration read_camera_json(const std::filesystem::path& path);

}  // namespace mms
