#include "mms/pipeline/session_places.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mms {

std::optional<std::uint32_t> session_of_map_frame(const GlobalMap& map, std::uint32_t sessions) {
  std::optional<std::uint32_t> first;
  for (std::uint32_t i = 0; i < sessions; ++i) {
    const auto session = map.session_of_run(i);
    if (!session) continue;
    if (map.is_joined(*session)) return session;
    if (!first) first = session;
  }
  return first;
}

std::optional<Transform<World, Sensor>> SessionPlace::corrected(
    Timestamp stamp, const Transform<World, Sensor>& T_world_sensor) const {
  if (!is_known) return std::nullopt;
  if (correction.empty()) return T_world_sensor;
  return Transform<World, Sensor>((correction.at(stamp) * T_world_sensor).isometry());
}

std::vector<SessionPlace> session_places(const GlobalMap& map, std::uint32_t sessions) {
  std::vector<SessionPlace> places(sessions);
  const auto frame = session_of_map_frame(map, sessions);
  if (!frame) return places;
  for (std::uint32_t i = 0; i < sessions; ++i) {
    const auto session = map.session_of_run(i);
    places[i].is_known = session && map.share_frame(*session, *frame);
    if (session) places[i].correction = map.correction(*session);
  }
  return places;
}

bool are_corrected(const std::vector<SessionPlace>& places) {
  return std::any_of(places.begin(), places.end(), [](const SessionPlace& place) {
    return !place.is_known || !place.correction.empty();
  });
}

MapCloud SessionPlace::corrected(StampedMap map) const {
  if (correction.empty()) return std::move(map.cloud);
  return moved(std::move(map.cloud), map.stamps,
               [&](Timestamp stamp) { return correction.at(stamp).isometry(); });
}

MapCloud joined_map(const std::vector<StampedMap>& maps, const std::vector<SessionPlace>& places) {
  assert(maps.size() == places.size());
  MapCloud joined;
  double voxel_size = 0.0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (!places[i].is_known) continue;
    append(joined, places[i].corrected(maps[i]));
    voxel_size = std::max(voxel_size, maps[i].voxel_size);
  }
  return merged(joined, voxel_size);
}

}  // namespace mms
