#include "mms/mapping/static_map/semantic_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace mms {
namespace {

/// [s]: longest time unseen across which a trajectory is drawn. Source: the `max_coast_output` of
/// `DynamicMapConfig`, for which an unseen object is reported.
constexpr double kMaxGap = 0.5;

/// [-]: R G B of people. Source: the paper's figure of the final map.
constexpr Rgb kRed = {230, 30, 30};

/// [-]: R G B of vehicles. Source: the paper's figure.
constexpr Rgb kGreen = {30, 190, 60};

/// [-]: R G B of unknown objects. Source: distinct from the two others.
constexpr Rgb kAmber = {240, 170, 30};

Rgb color_of(ObjectClass object_class) {
  constexpr Rgb kColors[kTrackedClassCount] = {kRed, kGreen, kAmber};
  return kColors[static_cast<int>(object_class)];
}

struct Observation {
  Timestamp stamp;
  const ObjectBox* box = nullptr;
};

/// Draws lines of points into a map.
class Pen {
 public:
  Pen(MapCloud& map, double spacing) : map_(map), spacing_(spacing) {}

  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Rgb color) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / spacing_)));
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      map_.points.emplace_back((from + share * (to - from)).cast<float>());
      map_.colors.push_back(color);
      map_.normals.emplace_back(Eigen::Vector3f::Zero());
      map_.observations.push_back(0);
    }
  }

  /// The twelve edges: from every corner along the axes on which it is at the low end.
  void box(const ObjectBox& object) {
    const Eigen::Vector3d half = 0.5 * object.size;
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) continue;
        line(object.T_world_box * place(corner, half),
             object.T_world_box * place(corner | 1 << axis, half), color_of(object.object_class));
      }
    }
  }

 private:
  static Eigen::Vector3d place(int corner, const Eigen::Vector3d& half) {
    Eigen::Vector3d point = -half;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) point[axis] = half[axis];
    }
    return point;
  }

  MapCloud& map_;
  double spacing_;
};

/// Center of the box's underside: trajectories are drawn on the floor.
Eigen::Vector3d base_of(const ObjectBox& object) {
  return object.T_world_box * Eigen::Vector3d(0.0, 0.0, -0.5 * object.size.z());
}

}  // namespace

MapCloud semantic_map(MapCloud map, const ObjectHistory& history, double spacing) {
  Pen pen(map, spacing);
  std::map<int, Observation> last;
  for (const ObjectFrame& frame : history) {
    for (const ObjectBox& object : frame.objects) {
      const auto [known, is_new] = last.try_emplace(object.id, Observation{frame.stamp, &object});
      const Observation& before = known->second;
      if (!is_new && to_seconds(frame.stamp - before.stamp) <= kMaxGap) {
        pen.line(base_of(*before.box), base_of(object), color_of(object.object_class));
      }
      known->second = {frame.stamp, &object};
    }
  }
  for (const auto& [id, seen] : last) pen.box(*seen.box);
  return map;
}

}  // namespace mms
