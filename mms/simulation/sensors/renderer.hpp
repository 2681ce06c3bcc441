#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/simulation/models/lights.hpp"
#include "mms/simulation/models/mesh.hpp"
#include "mms/simulation/sensors/exact_view.hpp"
#include "mms/simulation/sensors/ray_scene.hpp"

namespace mms {

/// A point on a surface, all that shading and sensors need to know of it.
struct SurfacePoint {
  Eigen::Vector3f position;     ///< world frame [m]
  Eigen::Vector3f face_normal;  ///< of the triangle, towards the ray's origin
  Eigen::Vector3f normal;       ///< smoothed, towards the ray's origin
  Eigen::Vector2f uv;           ///< [m]
  const Material* material = nullptr;
};

/// What the rays of a scene meet. The meshes have to outlive it.
class SurfaceLookup {
 public:
  SurfaceLookup(const Mesh& fixed, std::vector<const Mesh*> parts);

  void place(std::vector<Eigen::Isometry3f> T_world_part) { T_ = std::move(T_world_part); }

  SurfacePoint at(const Ray& ray, const RayHit& hit) const;

 private:
  const Mesh& fixed_;
  std::vector<const Mesh*> parts_;
  std::vector<Eigen::Isometry3f> T_;
};

/// A camera's rays: pixel i looks along `rays[i]` (z = 1) in the camera frame.
struct RayTable {
  int width = 0;
  int height = 0;
  float pixel_angle = 0.002F;  ///< what a pixel covers at 1 m [m]
  std::vector<Eigen::Vector3f> rays;
};

/// @throws DataError when the intrinsics make no camera.
RayTable ray_table(const CameraIntrinsics& camera);

/// What is wanted of a look at a scene; both images of the table's size.
struct RenderTarget {
  ExactView* view = nullptr;                   ///< is overwritten
  Image<Eigen::Vector3f>* radiance = nullptr;  ///< `weight` of the light is added: 1 is what a
                                               ///< white surface sends under good light
  float weight = 1.0F;
};

/// Looks at the scene from a camera; `object_of_part[i]` is 1 + id of the object that moving part i
/// belongs to.
void render(const RayScene& scene, const SurfaceLookup& surfaces, const Lights& lights,
            const std::vector<std::uint8_t>& object_of_part, const RayTable& table,
            const Eigen::Isometry3f& T_world_camera, const RenderTarget& target);

}  // namespace mms
