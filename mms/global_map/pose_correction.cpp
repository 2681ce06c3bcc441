#include "mms/global_map/pose_correction.hpp"

#include <algorithm>

#include "mms/geometry/se3.hpp"

namespace mms {

Transform<Global, World> PoseCorrection::at(Timestamp stamp) const {
  if (entries_.empty()) return {};
  const auto later =
      std::lower_bound(entries_.begin(), entries_.end(), stamp,
                       [](const Entry& entry, Timestamp t) { return entry.stamp < t; });
  if (later == entries_.begin()) return later->T_global_world;
  if (later == entries_.end()) return entries_.back().T_global_world;
  const auto earlier = later - 1;
  const double share =
      to_seconds(stamp - earlier->stamp) / to_seconds(later->stamp - earlier->stamp);
  const Eigen::Isometry3d& from = earlier->T_global_world.isometry();
  const Eigen::Isometry3d change = from.inverse() * later->T_global_world.isometry();
  return Transform<Global, World>(from * se3::interpolate(change, share));
}

}  // namespace mms
