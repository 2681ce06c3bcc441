#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/mapping/free_space/free_space.hpp"

namespace mms {

/// The static surfaces of places where the sensor was, one view for each position and direction,
/// for when it comes back. Holds the last 64.
class PlaceViews {
 public:
  /// Adds the static surfaces of a view, unless there is one of this place.
  void add(Timestamp stamp, const FreeSpace& statics,
           const Transform<World, Sensor>& T_world_sensor);

  /// The views nearest to a sensor.
  class Query {
   public:
    /// Whether at least two views had a static surface there (sensor frame [m]).
    bool is_on_surface(const Eigen::Vector3f& point) const;

   private:
    friend class PlaceViews;
    std::vector<std::pair<const FreeSpace*, Eigen::Isometry3f>> views_;
  };

  /// @param min_age  of the views [s]
  Query query(Timestamp now, double min_age, const Transform<World, Sensor>& T_world_sensor) const;

 private:
  struct View {
    Timestamp stamp;
    FreeSpace statics;
    Transform<World, Sensor> T_world_sensor;
  };

  std::deque<View> views_;
};

}  // namespace mms
