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

/// Box of half extent `half` [m] about the origin of `T`; every face has uv from its own corner.
void add_box(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& half,
             std::uint32_t material);

/// Ellipsoid with semi-axes `radii` [m] about the origin of `T`.
void add_ellipsoid(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& radii,
                   std::uint32_t material, int segments = 16);

/// Cross-section of a loft: an ellipse parallel to the xy plane.
struct Ring {
  float z;         ///< height [m]
  float rx;        ///< semi-axis along x [m]
  float ry;        ///< semi-axis along y [m]
  float x = 0.0F;  ///< centre [m]
  float y = 0.0F;  ///< centre [m]
};

/// Smooth skin over rings of ascending z, closed flat at both ends. Limbs, torsos, wheels, posts.
/// Seen along the surface the ends are sharp edges, the rest is smooth.
void add_loft(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Ring> rings,
              std::uint32_t material, int segments = 16);

/// Cylinder along z between -half_length and +half_length.
void add_cylinder(Mesh& mesh, const Eigen::Isometry3f& T, float radius, float half_length,
                  std::uint32_t material, int segments = 20);

/// Prism: a convex or concave simple polygon in the xz plane (counter-clockwise seen from -y,
/// that is with x to the right and z up), extended along y from -half_width to +half_width.
/// Bodies of vehicles. The polygon has to be star-shaped about its centroid.
void add_prism(Mesh& mesh, const Eigen::Isometry3f& T, std::span<const Eigen::Vector2f> polygon,
               float half_width, std::uint32_t material);

}  // namespace mms
