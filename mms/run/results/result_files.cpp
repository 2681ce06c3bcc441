#include "mms/run/results/result_files.hpp"

#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/mapping/static_map/intensity_grey.hpp"

namespace mms {

MapCloud result_map(const StaticMap& map, MapFrame frame) {
  return frame == MapFrame::kLidar ? map.cloud_with_normals() : map.cloud();
}

MapCloud result_map(const Mapping& mapping, MapFrame frame,
                    const std::vector<SessionPlace>& places) {
  if (are_corrected(places)) return joined_map(mapping.session_maps(), places);
  return result_map(mapping.static_map(), frame);
}

std::vector<std::string> ply_comments(MapFrame frame) {
  return {"units: m", frame == MapFrame::kCamera
                          ? "frame: first camera frame of the map, x right, y down, z forward"
                          : "frame: first LiDAR frame of the map, x forward, y left, z up"};
}

PointCloudFile file_of(const MapCloud& map, MapFrame frame) {
  PointCloudFile file;
  file.points = map.points;
  file.normals = map.normals;
  file.colors = map.colors;
  file.observations = map.observations;
  if (frame == MapFrame::kLidar) file.intensities = intensities_of(map.colors);
  return file;
}

void write_result_files(const std::filesystem::path& folder, const Trajectory& trajectory,
                        const Trajectory& keyframes, const MapCloud& map, MapFrame frame) {
  const PointCloudFile file = file_of(map, frame);
  write_trajectory_tum(folder / "trajectory.tum", trajectory);
  write_trajectory_kitti(folder / "trajectory_kitti.txt", trajectory);
  write_trajectory_tum(folder / "keyframes.tum", keyframes);
  write_ply(folder / "static_map.ply", file, ply_comments(frame));
  write_pcd(folder / "static_map.pcd", file);
}

}  // namespace mms
