#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "mms/simulation/models/material.hpp"

namespace mms {

/// Corner of a triangle. Triangles with different normals or textures do not share corners.
struct Vertex {
  Eigen::Vector3f position;  ///< [m]
  Eigen::Vector3f normal;    ///< unit, outwards
  Eigen::Vector2f uv;        ///< texture coordinates [m]
};

/// Three vertices, counter-clockwise from outside, and an index into the mesh's materials.
struct Triangle {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t material;
};

/// Surface of a rigid body in its own frame.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Material> materials;

  /// Adds a material and returns its index.
  std::uint32_t add(const Material& material) {
    materials.push_back(material);
    return static_cast<std::uint32_t>(materials.size() - 1);
  }
};

/// Appends the shapes of `part`; `T` is the transform from its frame to the mesh's.
void append(Mesh& mesh, const Mesh& part, const Eigen::Isometry3f& T);

/// Mirrors the shapes at the plane x = 0.
void mirror(Mesh& mesh);

/// Bounds of all vertices under `T`.
Eigen::AlignedBox3f bounds(const Mesh& mesh, const Eigen::Isometry3f& T);

}  // namespace mms
