#pragma once

#include <Eigen/Geometry>

namespace mms {

/// Two bones in a row, each with its origin at its upper joint, -z along the bone and x in front.
struct BentLimb {
  Eigen::Isometry3f upper;
  Eigen::Isometry3f lower;
};

/// Bends a limb of two bones of `upper` and `lower` length [m] so that it starts at `root` and ends
/// at `end`, or as near as it reaches. The joint between lies in the plane through both that
/// contains `front`: before the straight line (a knee), or behind it when `knee` is false (an
/// elbow). `front` must not be along the limb.
BentLimb bend_limb(const Eigen::Vector3f& root, const Eigen::Vector3f& end,
                   const Eigen::Vector3f& front, float upper, float lower, bool knee);

}  // namespace mms
