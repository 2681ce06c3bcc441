#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>

#include "mms/core/config.hpp"
#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/transform.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/mapping/free_space.hpp"

namespace mms {

struct MovementConfig {
  bool enabled = true;
  double memory = 3.0;     ///< [s]
  double interval = 0.5;   ///< [s]
  double margin = 0.15;    ///< [m]
  double radius = 0.08;    ///< [m]
  double max_share = 0.4;  ///< of the static points

  void visit(ConfigVisitor& v) {
    v.boolean({"enabled", "", "take what stands where space was free for dynamic, mask or not"},
              enabled);
    v.number({"memory", "s", "how long free space is remembered"}, memory, {0.0, 60.0});
    v.number({"interval", "s", "time between the views that are remembered"}, interval,
             {0.05, 60.0});
    v.number({"margin", "m", "how far behind a point a view has to have seen, above noise"}, margin,
             {0.01, 10.0});
    v.number({"radius", "m", "of the largest disc that fits into what is seen of the thing"},
             radius, {0.01, 10.0});
    v.number({"max_share", "", "of the static points; more is an error of the pose"}, max_share,
             {0.0, 1.0});
  }
};

/// Finds what moves without a name (beyond the paper, which knows only what the network was
/// taught): points that stand where a view some moments ago looked through. A person whom the
/// network missed is found like a cart that it never learned. Of organised clouds only.
class Movement {
 public:
  Movement(const MovementConfig& config, const DepthNoise& noise)
      : config_(config), noise_(noise) {}

  /// Makes static points of `cloud` dynamic that stand in free space, as far as they belong to
  /// things wider than the rims that an error of `T_world_sensor`, the expected pose, gives. A
  /// thing that adjoins a cluster becomes a part of it, any other one a cluster of unknown class.
  /// @returns non-zero at their pixels; empty where there are none
  Image<std::uint8_t> relabel(LabeledCloud& cloud,
                              const Transform<World, Sensor>& T_world_sensor) const;

  /// Adds a view with its estimated pose; views that follow the last one too soon are left out.
  void remember(const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor);

 private:
  struct View {
    Timestamp stamp;
    FreeSpace free_space;
    Eigen::Isometry3f T_sensor_world;
  };

  bool is_forgotten(const View& view, Timestamp now) const;

  MovementConfig config_;
  DepthNoise noise_;
  std::deque<View> views_;
};

}  // namespace mms
