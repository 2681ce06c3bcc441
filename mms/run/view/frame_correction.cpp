#include "mms/run/view/frame_correction.hpp"

#include <algorithm>
#include <string>

#include "mms/evaluation/tracking/tracking_error.hpp"
#include "mms/global_map/loops/loop.hpp"

namespace mms {
namespace {

/// From the world frame of a frame's session to that of the present pose, as a correction knew it.
Eigen::Isometry3d motion_of(const MapCorrection& correction, std::uint32_t session,
                            Timestamp stamp) {
  const bool is_known = correction.T_global_world && correction.places &&
                        session < correction.places->size() &&
                        (*correction.places)[session].is_known;
  if (!is_known) return Eigen::Isometry3d::Identity();
  return correction.T_global_world->isometry().inverse() *
         (*correction.places)[session].correction.at(stamp).isometry();
}

}  // namespace

void correct_frame(SceneFrame& frame, std::uint32_t session, const MapCorrection* before,
                   const MapCorrection& now) {
  Eigen::Isometry3d T = motion_of(now, session, frame.stamp);
  if (before != nullptr) T = T * motion_of(*before, session, frame.stamp).inverse();
  frame.T_world_sensor = Transform<World, Sensor>(T * frame.T_world_sensor.isometry());
  frame.objects = transformed({{frame.stamp, frame.objects}}, T).front().objects;
}

std::vector<SceneLoop> loops_between(const std::vector<Timestamp>& stamps,
                                     const std::vector<ClosedLoop>& loops) {
  const auto index_of = [&](Timestamp stamp) {
    return static_cast<std::size_t>(std::lower_bound(stamps.begin(), stamps.end(), stamp) -
                                    stamps.begin());
  };
  std::vector<SceneLoop> between;
  for (const ClosedLoop& loop : loops) {
    const std::size_t later = index_of(loop.later);
    if (later == stamps.size()) continue;
    between.push_back(
        {index_of(loop.earlier), later, true, std::string(to_string(LoopOutcome::kAccepted))});
  }
  return between;
}

}  // namespace mms
