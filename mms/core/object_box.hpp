#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// A dynamic object at one instant, tracked or ground truth: an upright box in the world frame.
struct ObjectBox {
  int id = 0;                                       ///< constant over all frames
  ObjectClass object_class = ObjectClass::kPerson;  ///< kUnknown: moves without a mask
  /// Center of the box; x forward, z up [m].
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< length, width, height [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in the world frame [m/s]
  bool moving = false;                                 ///< whether it moves at this instant
  double score = 1.0;    ///< confidence in the class, in [0, 1]; of tracks only
  double visible = 1.0;  ///< visible share, in [0, 1]; of ground truth only

  /// Center of the box in the world frame [m].
  Eigen::Vector3d center() const { return T_world_box.translation(); }
};

/// All objects of one frame.
struct ObjectFrame {
  Timestamp stamp;                 ///< of the frame
  std::vector<ObjectBox> objects;  ///< by id
};

/// Frames in order of time.
using ObjectHistory = std::vector<ObjectFrame>;

}  // namespace mms
