#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Motion state of an object at one instant, from which its pose is computed.
struct Activity {
  double seconds = 0.0;    ///< time, for autonomous motion (a scanner's head, a worker's arms)
  double travelled = 0.0;  ///< path length since time 0, for legs and wheels [m]
  double speed = 0.0;      ///< present speed [m/s]
};

/// A person or an AGV: rigid parts with joints. Object frame: origin on the floor below the center,
/// x forward, z up.
class ArticulatedModel {
 public:
  virtual ~ArticulatedModel() = default;

  virtual ObjectClass object_class() const = 0;

  /// Kind of object for ground-truth files: "person", "forklift", ...
  virtual std::string kind() const = 0;

  /// Shapes of the parts, each in its own frame; constant.
  virtual const std::vector<Mesh>& parts() const = 0;

  /// T_object_part of every part; continuous in all of `activity`.
  virtual std::vector<Eigen::Isometry3f> pose(const Activity& activity) const = 0;
};

}  // namespace mms
