#include "objects_json.hpp"

#include <nlohmann/json.hpp>

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const ObjectObservation& seen) {
  return {{"stamp", seen.stamp.to_string()},
          {"centroid", json_of(seen.centroid)},
          {"box_min", json_of(seen.box_min)},
          {"box_max", json_of(seen.box_max)},
          {"velocity", json_of(seen.velocity)}};
}

Json json_of(const Track& track) {
  Json history = Json::array();
  for (const ObjectObservation& seen : track.history) history.push_back(json_of(seen));
  return {{"id", track.id},
          {"class", to_string(track.object_class)},
          {"state", to_string(track.state)},
          {"velocity", json_of(track.velocity)},
          {"history", std::move(history)}};
}

}  // namespace

std::string objects_json(const DynamicMap& map) {
  Json tracks = Json::array();
  for (const Track& track : map.tracks()) {
    if (track.state != TrackState::kTentative) tracks.push_back(json_of(track));
  }
  return Json{{"tracks", std::move(tracks)}}.dump(1) + "\n";
}

}  // namespace mms
