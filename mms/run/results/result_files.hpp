#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/io/cloud/point_cloud_file.hpp"
#include "mms/mapping/static_map/static_map.hpp"
#include "mms/pipeline/mapping.hpp"
#include "mms/pipeline/session_places.hpp"

namespace mms {

/// Axes of the world frame, those of the first sensor frame.
enum class MapFrame {
  kCamera,  ///< x right, y down, z forward
  kLidar,   ///< x forward, y left, z up
};

/// The map of the present session for result files: that of a LiDAR has a normal for every point.
MapCloud result_map(const StaticMap& map, MapFrame frame);

/// The map of all sessions of a run whose place is known, in the frame of the map.
MapCloud result_map(const Mapping& mapping, MapFrame frame,
                    const std::vector<SessionPlace>& places);

/// Comments of PLY files that say their frame.
std::vector<std::string> ply_comments(MapFrame frame);

/// The map as content of a point cloud file; that of a LiDAR without a camera with intensities.
PointCloudFile file_of(const MapCloud& map, MapFrame frame);

/// Writes trajectory.tum, trajectory_kitti.txt, keyframes.tum, static_map.ply and static_map.pcd.
/// @throws FileError with the file that cannot be written.
void write_result_files(const std::filesystem::path& folder, const Trajectory& trajectory,
                        const Trajectory& keyframes, const MapCloud& map, MapFrame frame);

}  // namespace mms
