#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/map_file/map_file.hpp"

namespace mms {

/// Whether the keyframes of a session are LiDAR scans; nothing where all are damaged.
std::optional<bool> has_scans(const GlobalMapContent& content, std::uint32_t session);

/// Numbers of the sessions that loops join to the first one.
std::vector<std::uint32_t> joined_sessions(const GlobalMapContent& content);

/// Static map of a session with its corrections, in the frame of its group.
StampedMap corrected_surfaces(const MapFile& file, const GlobalMapContent& content,
                              std::uint32_t session, const MapFile::WarningHandler& warn);

/// Static map of all joined sessions in the frame of the map, which is the world of the first one.
/// Points of several sessions in one voxel are merged.
/// @param warn  called for each damaged part that is left out
MapCloud composed_map(const MapFile& file, const GlobalMapContent& content,
                      const MapFile::WarningHandler& warn);

/// Corrected poses of the keyframes of a session.
Trajectory session_trajectory(const GlobalMapContent& content, std::uint32_t session);

}  // namespace mms
