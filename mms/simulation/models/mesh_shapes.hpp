#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Pose of a shape without rotation.
inline Eigen::Isometry3f at(float x, float y, float z) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() = Eigen::Vector3f(x, y, z);
  return T;
}

/// Box of half extent `half` [m] centered at the origin of `T`; uv of each face from its corner.
void add_box(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& half,
             std::uint32_t material);

/// Ellipsoid with semi-axes `radii` [m] centered at the origin of `T`.
void add_ellipsoid(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& radii,
                   std::uint32_t material, int segments = 16);

/// Cross-section of a loft: an ellipse parallel to the xy plane.
struct Ring {
  float z = 0.0F;   ///< height [m]
  float rx = 0.0F;  ///< semi-axis along x [m]
  float ry = 0.0F;  ///< semi-axis along y [m]
  float x = 0.0F;   ///< center [m]
  float y = 0.0F;   ///< center [m]
};

/// Smooth surface through rings of ascending z, with flat ends and sharp edges there. For limbs,
/// torsos, wheels, posts.
void add_loft(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Ring> rings,
              std::uint32_t material, int segments = 16);

/// Cylinder along z between -half_length and +half_length.
void add_cylinder(Mesh& mesh, const Eigen::Isometry3f& T, float radius, float half_length,
                  std::uint32_t material, int segments = 20);

/// Prism: a simple polygon in the xz plane (counter-clockwise from -y, with x to the right and z
/// up), extruded along y from -half_width to +half_width. For bodies of vehicles. The polygon must
/// be star-shaped about its centroid.
void add_prism(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Eigen::Vector2f> polygon,
               float half_width, std::uint32_t material);

}  // namespace mms
