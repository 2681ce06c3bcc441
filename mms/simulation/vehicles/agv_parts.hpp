#pragma once

#include <cstdint>

#include "mms/simulation/models/mesh_shapes.hpp"
#include "mms/simulation/vehicles/agv_style.hpp"

namespace mms {

/// Rotates z to y: cylinders across the vehicle.
Eigen::Isometry3f across();

/// A box from `low` to `high` [m].
void add_block(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
               std::uint32_t material);

/// A body with beveled upper and vertical edges: a box with `bevel` [m] cut off.
void add_bevelled(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high, float bevel,
                  std::uint32_t material);

/// Round bar of `radius` [m] between two points.
void add_bar(Mesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius,
             std::uint32_t material, int segments = 10);

/// Adds a rolling wheel with its axle at (x, y).
void add_wheel(AgvAssembly& agv, const AgvStyle& style, float x, float y, float radius, float width,
               const Material& hub);

/// Adds a beacon on a socket with its base at `T`.
void add_lamp(Mesh& mesh, const Eigen::Isometry3f& T, const AgvStyle& style, float size);

/// Adds a LiDAR with its base at `T`: housing, window, lid.
void add_lidar(Mesh& mesh, const Eigen::Isometry3f& T, const AgvStyle& style, float radius,
               float height);

/// A rectangle of hazard stripes on a thin plate.
void add_hazard_plate(Mesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
                      const AgvStyle& style);

}  // namespace mms
