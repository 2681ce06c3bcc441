#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Ray in the world frame. Distances are in lengths of `direction`, which need not be a unit
/// vector: with z = 1 in the camera frame they are depths.
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

/// Triangles for ray casting: one fixed mesh and rigid moving parts (wraps Embree). `cast` is
/// thread-safe, but not concurrent with `place`. Results do not depend on the number of threads.
class RayScene {
 public:
  /// Copies the meshes.
  /// @throws Error if Embree lacks memory or a supported instruction set.
  RayScene(const Mesh& fixed, std::span<const Mesh* const> parts);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  std::size_t part_count() const;

  /// Sets the poses of all parts, in order.
  void place(std::span<const Eigen::Isometry3f> T_world_part);

  /// First hit of every ray.
  void cast(std::span<const Ray> rays, std::span<RayHit> hits) const;

  /// First hit of every ray with parts [first, last) alone.
  void cast_at_parts(std::span<const Ray> rays, std::size_t first, std::size_t last,
                     std::span<RayHit> hits) const;

  /// Whether each ray hits anything within its reach.
  void blocked(std::span<const Ray> rays, std::span<std::uint8_t> result) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
