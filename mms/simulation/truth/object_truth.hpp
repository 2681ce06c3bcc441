#pragma once

#include <Eigen/Geometry>
#include <string>

#include "mms/core/segmentation.hpp"

namespace mms {

/// Rectangle in an image, in pixels; empty without width. May exceed the image.
struct PixelBox {
  double x = 0.0;  ///< left edge
  double y = 0.0;  ///< upper edge
  double width = 0.0;
  double height = 0.0;
  bool empty() const { return width <= 0.0 || height <= 0.0; }
};

/// Ground truth of a person or AGV in one frame.
struct ObjectTruth {
  int id = 0;  ///< from 0 on, constant over all frames; its value in instance images is 1 + id
  ObjectClass object_class = ObjectClass::kPerson;
  std::string kind;  ///< "person", "forklift", ...
  /// Center of the bounding box of its body at this instant; x forward, z up.
  Eigen::Isometry3d T_world_box = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extent = Eigen::Vector3d::Zero();  ///< of the box [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();     ///< of its origin, world frame [m/s]
  bool moving = false;                                    ///< faster than 0.05 m/s
  PixelBox visible;                                       ///< bounding box of its visible pixels
  PixelBox amodal;  ///< bounding box of its whole projection, including hidden and truncated parts
  int pixels = 0;   ///< visible in the image
  double occlusion = 0.0;   ///< share of its pixels inside the image that are occluded
  double truncation = 0.0;  ///< share of the amodal box that lies outside the image
};

}  // namespace mms
