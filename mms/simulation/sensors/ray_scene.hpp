#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Half-line in the world frame. Distances along it count in lengths of `direction`, which need not
/// be of unit length: a direction with z = 1 in the camera frame makes them depths.
struct Ray {
  Eigen::Vector3f origin;  ///< [m]
  Eigen::Vector3f direction;
  float reach = 1e4F;  ///< in lengths of the direction
};

/// First surface on a ray.
struct RayHit {
  static constexpr std::int32_t kNothing = -1;

  float distance = 0.0F;         ///< in lengths of the ray's direction
  std::int32_t part = kNothing;  ///< 0: the fixed mesh, 1 + i: moving part i
  std::uint32_t triangle = 0;    ///< of that mesh
  float u = 0.0F;                ///< barycentric weight of the triangle's second corner
  float v = 0.0F;                ///< ... and of its third

  bool valid() const { return part != kNothing; }
};

/// Triangles that rays can be shot at: one fixed mesh and rigid parts that move (Embree behind one
/// file). Rays may be cast from many threads; placing parts excludes casting. The same rays at the
/// same parts give the same hits for any number of threads.
class RayScene {
 public:
  /// The meshes are copied.
  /// @throws Error when Embree finds no memory or no usable instruction set.
  RayScene(const Mesh& fixed, std::span<const Mesh* const> parts);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  std::size_t part_count() const;

  /// Moves all parts, in their order.
  void place(std::span<const Eigen::Isometry3f> T_world_part);

  /// First hit of every ray.
  void cast(std::span<const Ray> rays, std::span<RayHit> hits) const;

  /// First hit of every ray among parts [first, last) alone, as if nothing else were there.
  void cast_at_parts(std::span<const Ray> rays, std::size_t first, std::size_t last,
                     std::span<RayHit> hits) const;

  /// Whether anything lies on each ray before its reach.
  void blocked(std::span<const Ray> rays, std::span<std::uint8_t> result) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
