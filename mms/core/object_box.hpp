#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// A dynamic object at one instant, as tracked or as it truly is: an upright box in the world.
struct ObjectBox {
  int id = 0;  ///< the same in all frames
  ObjectClass object_class = ObjectClass::kPerson;
  /// Of the box's middle; x forward, z up [m].
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< length, width, height [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in the world frame [m/s]
  bool moving = false;
  double score = 1.0;    ///< confidence that it is one of its class, in [0, 1]; of tracks only
  double visible = 1.0;  ///< share of it in view, in [0, 1]; known of truth only

  Eigen::Vector3d center() const { return T_world_box.translation(); }
};

/// All objects of one frame.
struct ObjectFrame {
  Timestamp stamp;
  std::vector<ObjectBox> objects;
};

/// By time.
using ObjectHistory = std::vector<ObjectFrame>;

}  // namespace mms
