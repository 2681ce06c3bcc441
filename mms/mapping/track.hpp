#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// One dynamic object as one frame measured it, in the world frame [m].
struct ObjectObservation {
  Timestamp stamp;
  ObjectClass object_class = ObjectClass::kPerson;
  float score = 1.0F;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero();  ///< axis-aligned in the world frame
  Eigen::Vector3d box_max = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of its track then [m/s]
};

enum class TrackState {
  kTentative,  ///< not seen often enough yet; may be a fluke
  kActive,     ///< seen in the last frame
  kCoasting,   ///< not seen in the last frame; expected where its velocity takes it
  kEnded,      ///< not seen for too long
};

constexpr std::string_view to_string(TrackState state) {
  constexpr std::array<std::string_view, 4> kNames = {"tentative", "active", "coasting", "ended"};
  return kNames[static_cast<std::size_t>(state)];
}

/// One dynamic object over time.
struct Track {
  int id = 0;  ///< unique in the map, from 1 on, never used again
  TrackState state = TrackState::kTentative;
  ObjectClass object_class = ObjectClass::kPerson;     ///< the one most frames saw
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< at the last observation [m/s]
  std::array<int, kObjectClassCount> votes{};          ///< observations by class
  std::vector<ObjectObservation> history;              ///< by time; never empty in a map

  /// Where the centroid is expected at `stamp` (constant velocity, world frame [m]).
  Eigen::Vector3d predicted(Timestamp stamp) const {
    return history.back().centroid + velocity * to_seconds(stamp - history.back().stamp);
  }
};

}  // namespace mms
