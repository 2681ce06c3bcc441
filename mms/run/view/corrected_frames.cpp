#include "mms/run/view/corrected_frames.hpp"

#include <algorithm>
#include <memory>
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

SceneFrames corrected_frames(const SceneFrames& shown, const std::vector<std::uint32_t>& sessions,
                             const MapCorrection& before, std::size_t corrected,
                             const MapCorrection& now) {
  SceneFrames frames;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Timestamp stamp = shown[i]->stamp;
    Eigen::Isometry3d T = motion_of(now, sessions[i], stamp);
    if (i < corrected) T = T * motion_of(before, sessions[i], stamp).inverse();
    auto frame = std::make_shared<SceneFrame>(*shown[i]);
    frame->T_world_sensor = Transform<World, Sensor>(T * frame->T_world_sensor.isometry());
    frame->objects = transformed({{stamp, frame->objects}}, T).front().objects;
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::vector<SceneLoop> loops_between(const SceneFrames& frames,
                                     const std::vector<ClosedLoop>& loops) {
  const auto index_of = [&](Timestamp stamp) {
    const auto found =
        std::lower_bound(frames.begin(), frames.end(), stamp,
                         [](const auto& frame, Timestamp other) { return frame->stamp < other; });
    return static_cast<std::size_t>(found - frames.begin());
  };
  std::vector<SceneLoop> between;
  for (const ClosedLoop& loop : loops) {
    const std::size_t later = index_of(loop.later);
    if (later == frames.size()) continue;
    between.push_back(
        {index_of(loop.earlier), later, true, std::string(to_string(LoopOutcome::kAccepted))});
  }
  return between;
}

}  // namespace mms
