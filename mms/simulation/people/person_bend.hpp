#pragma once

#include <Eigen/Geometry>

namespace mms {

/// Two consecutive bones, each with its origin at its upper joint, -z along the bone and x forward.
struct BentLimb {
  Eigen::Isometry3f upper;
  Eigen::Isometry3f lower;
};

/// Inverse kinematics of two bones of `upper` and `lower` length [m] from `root` to `end`, or as
/// close as they reach. The joint lies in the plane that contains `front`: in front of the
/// straight line (a knee), or behind it if `knee` is false (an elbow). `front` must not be parallel
/// to the limb.
BentLimb bend_limb(const Eigen::Vector3f& root, const Eigen::Vector3f& end,
                   const Eigen::Vector3f& front, float upper, float lower, bool knee);

}  // namespace mms
