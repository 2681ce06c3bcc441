#pragma once

#include <filesystem>
#include <optional>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"

namespace mms {

/// The published color intrinsics of the TUM benchmark for a folder with freiburg1 (or fr1), 2 or 3
/// in its name, of the Bonn RGB-D Dynamic data set for one with rgbd_bonn; nullopt for other names.
std::optional<Calibration> default_calibration(const std::filesystem::path& folder);

/// The published intrinsics of ICL-NUIM, for images whose y axis is down.
Calibration icl_nuim_calibration();

/// Reads calibration.txt of ETH3D: fx fy cx cy [px]. Images have no distortion, and their size is
/// that of `image`.
/// @throws FileError if the file cannot be read; DataError for other content.
Calibration read_eth3d_calibration(const std::filesystem::path& file, const Image<Rgb>& image);

}  // namespace mms
