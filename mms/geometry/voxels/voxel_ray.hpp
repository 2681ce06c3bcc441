#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// State of a voxel traversal along one axis.
struct VoxelStep {
  std::int32_t direction = 0;
  std::int32_t left = 0;  ///< remaining steps; counted, so that rounding cannot pass the end
  float next = 0.0F;      ///< segment parameter at which the next voxel begins
  float pitch = 0.0F;     ///< segment parameter per voxel

  VoxelStep(float from, float to) {
    const auto at = static_cast<std::int32_t>(std::floor(from));
    const auto end = static_cast<std::int32_t>(std::floor(to));
    direction = end < at ? -1 : 1;
    left = std::abs(end - at);
    pitch = 1.0F / std::abs(to - from);
    const auto border = static_cast<float>(end < at ? at : at + 1);
    next = left > 0 ? std::abs(border - from) * pitch : kNever;
  }

  void take(std::int32_t& coordinate) {
    coordinate += direction;
    next = --left > 0 ? next + pitch : kNever;
  }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();
};

/// Calls `visit(key)` for the voxels along the segment in order, both ends included, until it
/// returns false; consecutive voxels share a face (Amanatides and Woo, 1987).
/// @param from, to in units of the voxel's side; finite and within 2^30 of the origin
template <class Visit>
void for_each_voxel(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Visit& visit) {
  VoxelKey key = voxel_key(from, 1.0F);
  VoxelStep x(from.x(), to.x());
  VoxelStep y(from.y(), to.y());
  VoxelStep z(from.z(), to.z());
  if (!visit(key)) return;
  for (int steps = x.left + y.left + z.left; steps > 0; --steps) {
    if (x.next <= y.next && x.next <= z.next) {
      x.take(key.x);
    } else if (y.next <= z.next) {
      y.take(key.y);
    } else {
      z.take(key.z);
    }
    if (!visit(key)) return;
  }
}

}  // namespace mms
