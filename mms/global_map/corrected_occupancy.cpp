#include "mms/global_map/corrected_occupancy.hpp"

#include <cstddef>

namespace mms {

OccupancyMap corrected_occupancy(const std::deque<KeyframeRecord>& records,
                                 const std::vector<Eigen::Isometry3d>& poses,
                                 const std::function<bool(std::uint32_t session)>& is_joined,
                                 const OccupancyConfig& config, const SurfaceConfig& surface) {
  OccupancyMap map(config, surface);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const KeyframeRecord& record = records[i];
    if (record.is_pose_only() || !is_joined(record.session)) continue;
    map.integrate(record.is_scan() ? record.scan.cloud() : record.view.cloud(),
                  Transform<World, Sensor>(poses[i]));
  }
  return map;
}

}  // namespace mms
