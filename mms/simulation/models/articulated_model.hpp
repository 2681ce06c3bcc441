#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// What an object is doing at one instant, as far as its body shows it.
struct Activity {
  double seconds = 0.0;    ///< time, for what moves by itself (a scanner's head, a worker's arms)
  double travelled = 0.0;  ///< way along the floor since time 0, for legs and wheels [m]
  double speed = 0.0;      ///< how fast it walks or drives just now [m/s]
};

/// A person or an AGV: rigid parts that move against each other. Object frame: origin on the floor
/// below the center, x forward, z up.
class ArticulatedModel {
 public:
  virtual ~ArticulatedModel() = default;

  virtual ObjectClass object_class() const = 0;

  /// What it is, for truth files: "person", "forklift", ...
  virtual std::string kind() const = 0;

  /// Shapes of the parts, each in its own frame; they never change.
  virtual const std::vector<Mesh>& parts() const = 0;

  /// T_object_part of every part; continuous in everything that `activity` says.
  virtual std::vector<Eigen::Isometry3f> pose(const Activity& activity) const = 0;
};

}  // namespace mms
