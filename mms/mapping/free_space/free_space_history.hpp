#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/free_space/space_state.hpp"

namespace mms {

/// Free space of the recent views; `Space` is that of one view.
template <class Space>
class FreeSpaceHistory {
 public:
  /// @param memory    age of the oldest view [s]
  /// @param interval  time between the views [s]
  FreeSpaceHistory(double memory, double interval) : memory_(memory), interval_(interval) {}

  /// Whether a view at this time is to be added; views older than `memory` are removed.
  bool wants(Timestamp stamp) {
    while (!views_.empty() && is_too_old(views_.front(), stamp)) views_.pop_front();
    return views_.empty() || to_seconds(stamp - views_.back().stamp) >= interval_;
  }

  void add(Timestamp stamp, Space space, const Transform<World, Sensor>& T_world_sensor) {
    views_.push_back(
        {stamp, std::move(space), T_world_sensor.isometry().inverse().template cast<float>()});
  }

  bool empty() const { return views_.empty(); }

  /// The views in the sensor frame of a new frame.
  class Query {
   public:
    /// Calls visit(space, point in its view's sensor frame [m]) for every view.
    /// @param point  in the frame's sensor frame [m]
    template <class Visit>
    void for_each(const Eigen::Vector3f& point, const Visit& visit) const {
      for (const auto& [space, T_view_sensor] : views_) visit(*space, T_view_sensor * point);
    }

    /// @param point  in the frame's sensor frame [m]
    SpaceState state_of(const Eigen::Vector3f& point) const {
      SpaceState state = SpaceState::kUnknown;
      for (const auto& [space, T_view_sensor] : views_) {
        const SpaceState here = space->state_at(T_view_sensor * point);
        if (here == SpaceState::kFree) return here;
        if (here == SpaceState::kSurface) state = here;
        if (here == SpaceState::kNoReturn && state == SpaceState::kUnknown) state = here;
      }
      return state;
    }

   private:
    friend class FreeSpaceHistory;
    std::vector<std::pair<const Space*, Eigen::Isometry3f>> views_;
  };

  Query query(Timestamp now, const Transform<World, Sensor>& T_world_sensor) const {
    Query query;
    for (const View& view : views_) {
      if (is_too_old(view, now)) continue;
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

  bool is_too_old(const View& view, Timestamp now) const {
    return to_seconds(now - view.stamp) > memory_;
  }

  double memory_;
  double interval_;
  std::deque<View> views_;
};

}  // namespace mms
