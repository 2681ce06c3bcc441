#include "mms/simulation/shading.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

/// Axis of the box face that `local` lies on.
int face_axis(const Solid& solid, const Eigen::Vector3f& local) {
  const Eigen::Array3f share = local.array().abs() / solid.half.array();
  if (share.x() > share.y()) return share.x() > share.z() ? 0 : 2;
  return share.y() > share.z() ? 1 : 2;
}

Eigen::Vector3f local_point(const Solid& solid, const Eigen::Vector3f& point) {
  return solid.T_room_solid.linear().transpose() * (point - solid.T_room_solid.translation());
}

/// Surface coordinates [m]: along the face of a box (v upright on walls), round an ellipsoid.
Eigen::Vector2f texture_coordinates(const Solid& solid, const Eigen::Vector3f& local) {
  if (solid.shape == Shape::kEllipsoid) return {local.z(), local.y()};
  const int axis = face_axis(solid, local);
  const Eigen::Vector2f uv = axis == 0   ? Eigen::Vector2f(local.y(), local.z())
                             : axis == 1 ? Eigen::Vector2f(local.x(), local.z())
                                         : Eigen::Vector2f(local.x(), local.y());
  return uv + Eigen::Vector2f::Constant(7.3F * static_cast<float>(axis));
}

/// Light from the ceiling and a window on one side.
float brightness(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f above(0.17F, 0.10F, 0.98F);
  const Eigen::Vector3f window(-0.75F, 0.60F, 0.27F);
  return 0.50F + 0.28F * std::max(0.0F, normal.dot(above)) +
         0.38F * std::max(0.0F, normal.dot(window)) + 0.08F * normal.z();
}

Rgb to_rgb(const Eigen::Vector3f& color) {
  const Eigen::Vector3f scaled = (255.0F * color).cwiseMax(0.0F).cwiseMin(255.0F);
  return {static_cast<std::uint8_t>(scaled.x()), static_cast<std::uint8_t>(scaled.y()),
          static_cast<std::uint8_t>(scaled.z())};
}

/// Outward normal in the solid's frame.
Eigen::Vector3f local_normal(const Solid& solid, const Eigen::Vector3f& local) {
  if (solid.shape == Shape::kEllipsoid) {
    return local.cwiseQuotient(solid.half.cwiseAbs2()).normalized();
  }
  const int axis = face_axis(solid, local);
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  normal(axis) = local(axis) < 0.0F ? -1.0F : 1.0F;
  return normal;
}

Rgb color_at(const Solid& solid, const Eigen::Vector3f& point, float footprint) {
  const Eigen::Vector3f local = local_point(solid, point);
  const Eigen::Vector2f uv = texture_coordinates(solid, local);
  const Eigen::Vector3f normal = solid.T_room_solid.linear() * local_normal(solid, local);
  return to_rgb(brightness(normal) * albedo(solid.material, uv.x(), uv.y(), footprint));
}

}  // namespace

Eigen::Vector3f surface_normal(const Solid& solid, const Eigen::Vector3f& point) {
  return solid.T_room_solid.linear() * local_normal(solid, local_point(solid, point));
}

Image<Rgb> shade(const CastImage& cast, const std::vector<Solid>& solids,
                 const CameraIntrinsics& camera, const Eigen::Isometry3d& T_room_camera) {
  const Eigen::Isometry3f T = T_room_camera.cast<float>();
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  Image<Rgb> image(camera.width, camera.height);
  parallel_chunks(static_cast<std::size_t>(camera.height), 16, [&](auto begin, auto end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < camera.width; ++x) {
        if (cast.solid(x, y) < 0) continue;
        const float z = cast.depth(x, y);
        const Eigen::Vector3f ray((static_cast<float>(x) - cx) / fx,
                                  (static_cast<float>(y) - cy) / fy, 1.0F);
        const Solid& solid = solids[static_cast<std::size_t>(cast.solid(x, y))];
        image(x, y) = color_at(solid, T * Eigen::Vector3f(z * ray), z / fx);
      }
    }
  });
  return image;
}

}  // namespace mms
