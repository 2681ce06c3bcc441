#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "mms/simulation/models/material.hpp"

namespace mms {

/// Corner of a triangle. Corners are not shared where the normal or the texture changes.
struct Vertex {
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f normal;    ///< unit, outwards
  Eigen::Vector2f uv;        ///< place on the surface for its material's pattern [m]
};

/// Three vertices, counter-clockwise seen from outside, and an index into the mesh's materials.
struct Triangle {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t material;
};

/// Surface of something rigid, in its own frame.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Material> materials;

  /// Index of a new material, to be given to the shapes that have it.
  std::uint32_t add(const Material& material) {
    materials.push_back(material);
    return static_cast<std::uint32_t>(materials.size() - 1);
  }
};

/// Moves the shapes of `part` into `mesh`; `T` takes coordinates of the part to the mesh's.
void append(Mesh& mesh, const Mesh& part, const Eigen::Isometry3f& T);

/// Bounds of all vertices under `T`.
Eigen::AlignedBox3f bounds(const Mesh& mesh, const Eigen::Isometry3f& T);

}  // namespace mms
