#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/motion_segmentation/motion_segmentation_config.hpp"

namespace mms {

/// What recent views observed at the position of a point.
enum class SpaceState : std::uint8_t {
  kNone,      ///< not a static point
  kSurface,   ///< a surface
  kUnknown,   ///< occluded or out of view
  kNoReturn,  ///< in view, but without a return at or behind it
  kFree,      ///< free space
};

/// Free space of the recent views; `Space` is that of one view.
template <class Space>
class FreeSpaceHistory {
 public:
  explicit FreeSpaceHistory(const MotionSegmentationConfig& config) : config_(config) {}

  /// Whether a view at this time is to be added; views older than `memory` are removed.
  bool wants(Timestamp stamp) {
    while (!views_.empty() && is_too_old(views_.front(), stamp)) views_.pop_front();
    return views_.empty() || to_seconds(stamp - views_.back().stamp) >= config_.interval;
  }

  void add(Timestamp stamp, Space space, const Transform<World, Sensor>& T_world_sensor) {
    views_.push_back(
        {stamp, std::move(space), T_world_sensor.isometry().inverse().template cast<float>()});
  }

  bool empty() const { return views_.empty(); }

  /// The views in the sensor frame of a new frame.
  class Query {
   public:
    /// @param point  in the frame's sensor frame [m]
    SpaceState state_of(const Eigen::Vector3f& point) const {
      SpaceState state = SpaceState::kUnknown;
      for (const auto& [space, T_view_sensor] : views_) {
        const Eigen::Vector3f there = T_view_sensor * point;
        if (space->sees_through(there)) return SpaceState::kFree;
        if (space->touches(there)) state = SpaceState::kSurface;
        if (state == SpaceState::kUnknown && space->has_no_return(there))
          state = SpaceState::kNoReturn;
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
    return to_seconds(now - view.stamp) > config_.memory;
  }

  MotionSegmentationConfig config_;
  std::deque<View> views_;
};

}  // namespace mms
