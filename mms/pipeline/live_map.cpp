#include "mms/pipeline/live_map.hpp"

#include <utility>

namespace mms {

std::vector<SessionPlace> places_at(const FrameResult& frame) {
  std::vector<SessionPlace> places(1);
  if (frame.correction.places) places = *frame.correction.places;
  places.resize(frame.session + std::size_t{1}, SessionPlace{.is_known = false, .correction = {}});
  return places;
}

MapCloud live_map(const Mapping& mapping, const FrameResult& frame) {
  const std::vector<SessionPlace> places = places_at(frame);
  if (!frame.correction.T_global_world || !are_corrected(places)) {
    return mapping.static_map().cloud();
  }
  MapCloud map = joined_map(mapping.session_maps(), places);
  const Eigen::Isometry3d T_world_global = frame.correction.T_global_world->isometry().inverse();
  const std::vector<Timestamp> any(map.size());
  return moved(std::move(map), any, [&](Timestamp) { return T_world_global; });
}

}  // namespace mms
