#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/mapping/occupancy/occupancy_map.hpp"

namespace mms {

/// Occupancy map of the small views of keyframes at their corrected poses, in the frame of the map.
/// Thin obstacles can be missing: the static map has them.
/// @param poses      by record
/// @param is_joined  whether a session is in the frame of the map
/// @param surface    as for `OccupancyMap`
OccupancyMap corrected_occupancy(const std::deque<KeyframeRecord>& records,
                                 const std::vector<Eigen::Isometry3d>& poses,
                                 const std::function<bool(std::uint32_t session)>& is_joined,
                                 const OccupancyConfig& config, const SurfaceConfig& surface);

}  // namespace mms
