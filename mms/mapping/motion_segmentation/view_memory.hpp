#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/motion_segmentation/movement_config.hpp"

namespace mms {

/// What earlier views say of a place.
enum class Place : std::uint8_t {
  kNone,     ///< there is no static point
  kSurface,  ///< it was there before
  kUnknown,  ///< hidden or out of view
  kBlank,    ///< looked at, but nothing was measured there or behind
  kFree,     ///< it was looked through
};

/// The free space that the last moments' views saw; `Space` is that of one view.
template <class Space>
class ViewMemory {
 public:
  explicit ViewMemory(const MovementConfig& config) : config_(config) {}

  /// Whether a view of this time is one to remember; old ones are forgotten.
  bool wants(Timestamp stamp) {
    while (!views_.empty() && is_forgotten(views_.front(), stamp)) views_.pop_front();
    return views_.empty() || to_seconds(stamp - views_.back().stamp) >= config_.interval;
  }

  void add(Timestamp stamp, Space space, const Transform<World, Sensor>& T_world_sensor) {
    views_.push_back(
        {stamp, std::move(space), T_world_sensor.isometry().inverse().template cast<float>()});
  }

  bool empty() const { return views_.empty(); }

  /// The views as a frame at `T_world_sensor` asks them.
  class Query {
   public:
    /// @param point  in the frame's sensor frame [m]
    Place place_of(const Eigen::Vector3f& point) const {
      Place place = Place::kUnknown;
      for (const auto& [space, T_view_sensor] : views_) {
        const Eigen::Vector3f there = T_view_sensor * point;
        if (space->sees_through(there)) return Place::kFree;
        if (space->touches(there)) place = Place::kSurface;
        if (place == Place::kUnknown && space->is_blank(there)) place = Place::kBlank;
      }
      return place;
    }

   private:
    friend class ViewMemory;
    std::vector<std::pair<const Space*, Eigen::Isometry3f>> views_;
  };

  Query query(Timestamp now, const Transform<World, Sensor>& T_world_sensor) const {
    Query query;
    for (const View& view : views_) {
      if (is_forgotten(view, now)) continue;
      query.views_.emplace_back(
          &view.space, view.T_sensor_world * T_world_sensor.isometry().template cast<float>());
    }
    return query;
  }

 private:
  struct View {
    Timestamp stamp;
    Space space;
    Eigen::Isometry3f T_sensor_world;
  };

  bool is_forgotten(const View& view, Timestamp now) const {
    return to_seconds(now - view.stamp) > config_.memory;
  }

  MovementConfig config_;
  std::deque<View> views_;
};

}  // namespace mms
