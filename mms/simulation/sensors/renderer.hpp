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

/// A surface point with the properties needed for shading and sensors.
struct SurfacePoint {
  Eigen::Vector3f position;     ///< world frame [m]
  Eigen::Vector3f face_normal;  ///< of the triangle, towards the ray's origin
  Eigen::Vector3f normal;       ///< smoothed, towards the ray's origin
  Eigen::Vector2f uv;           ///< [m]
  const Material* material = nullptr;
};

/// Properties of the surfaces that rays hit. The meshes must outlive it.
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

/// Rays of a camera: pixel i has the direction `rays[i]` (z = 1) in the camera frame.
struct RayTable {
  int width = 0;
  int height = 0;
  float pixel_angle = 0.002F;  ///< size of a pixel at a distance of 1 m [m]
  std::vector<Eigen::Vector3f> rays;
};

/// @throws DataError if the intrinsics are invalid.
RayTable ray_table(const CameraIntrinsics& camera);

/// Outputs of a rendering; both images have the table's size.
struct RenderTarget {
  ExactView* view = nullptr;                   ///< is overwritten
  Image<Eigen::Vector3f>* radiance = nullptr;  ///< `weight` of the light is added: 1 is the
                                               ///< radiance of a white surface under good light
  float weight = 1.0F;
};

/// Renders the scene from a camera; `object_of_part[i]` is 1 + id of the object of moving part i.
void render(const RayScene& scene, const SurfaceLookup& surfaces, const Lights& lights,
            const std::vector<std::uint8_t>& object_of_part, const RayTable& table,
            const Eigen::Isometry3f& T_world_camera, const RenderTarget& target);

}  // namespace mms
