#pragma once

#include <filesystem>
#include <vector>

#include "mms/dataset/lidar/scan_format.hpp"

namespace mms {

/// Number of float32 of a point in the scans of a recording, x y z first: 4 with reflectance as in
/// KITTI, 3 without, 5 or 6 with ring or time as in nuScenes. Files have no head that says so:
/// scans have a whole number of points, and points that follow each other are close together.
/// 4 where nothing speaks against it.
int floats_per_point(const std::vector<std::filesystem::path>& scans);

/// The format of such scans.
ScanFormat float_format(int floats);

}  // namespace mms
