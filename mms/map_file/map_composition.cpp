#include "mms/map_file/map_composition.hpp"

#include <algorithm>
#include <utility>

#include "mms/global_map/graph/session_groups.hpp"

namespace mms {

std::optional<bool> has_scans(const GlobalMapContent& content, std::uint32_t session) {
  const auto readable = std::find_if(content.records.begin(), content.records.end(),
                                     [&](const KeyframeRecord& record) {
                                       return record.session == session && !record.is_pose_only();
                                     });
  if (readable == content.records.end()) return std::nullopt;
  return readable->is_scan();
}

std::vector<std::uint32_t> joined_sessions(const GlobalMapContent& content) {
  SessionGroups groups;
  for (std::size_t i = 0; i < content.records.size(); ++i) {
    if (content.records[i].session == groups.size()) groups.add(i);
  }
  for (const Loop& loop : content.loops) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    groups.join(content.records[loop.candidate].session, content.records[loop.query].session);
  }
  std::vector<std::uint32_t> joined;
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    if (groups.group_of(i) == 0) joined.push_back(i);
  }
  return joined;
}

StampedMap corrected_surfaces(const MapFile& file, const GlobalMapContent& content,
                              std::uint32_t session, const MapFile::WarningHandler& warn) {
  StampedMap surfaces = file.surfaces(session, warn);
  const PoseCorrection correction =
      session_correction(content.records, content.poses, content.loops, session);
  if (correction.empty()) return surfaces;
  surfaces.cloud = moved(std::move(surfaces.cloud), surfaces.stamps,
                         [&](Timestamp stamp) { return correction.at(stamp).isometry(); });
  return surfaces;
}

MapCloud composed_map(const MapFile& file, const GlobalMapContent& content,
                      const MapFile::WarningHandler& warn) {
  MapCloud map;
  double voxel_size = 0.0;
  for (const std::uint32_t session : joined_sessions(content)) {
    append(map, corrected_surfaces(file, content, session, warn).cloud);
    voxel_size = std::max(voxel_size, file.sessions()[session].voxel_size);
  }
  // Without loops, the static map of a session has one point a voxel already.
  const bool has_loops =
      std::any_of(content.loops.begin(), content.loops.end(),
                  [](const Loop& loop) { return loop.outcome == LoopOutcome::kAccepted; });
  return has_loops ? merged(map, voxel_size) : map;
}

Trajectory session_trajectory(const GlobalMapContent& content, std::uint32_t session) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < content.records.size(); ++i) {
    const KeyframeRecord& record = content.records[i];
    if (record.session != session) continue;
    trajectory.push_back({record.stamp, Transform<World, Sensor>(content.poses[i])});
  }
  return trajectory;
}

}  // namespace mms
