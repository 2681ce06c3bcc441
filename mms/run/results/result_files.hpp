#pragma once

#include <filesystem>

#include "mms/core/trajectory.hpp"
#include "mms/io/cloud/point_cloud_file.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

/// The map as content of a point cloud file.
PointCloudFile file_of(const MapCloud& map);

/// Writes trajectory.tum, trajectory_kitti.txt, keyframes.tum, static_map.ply and static_map.pcd.
/// @throws FileError with the file that cannot be written.
void write_result_files(const std::filesystem::path& folder, const Trajectory& trajectory,
                        const Trajectory& keyframes, const MapCloud& map);

}  // namespace mms
