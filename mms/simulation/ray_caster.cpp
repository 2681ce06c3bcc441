#include "mms/simulation/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A solid as the camera sees it: rays start at `origin` and pixel (x, y) looks along
/// first + x * per_column + y * per_row, in the solid's frame with its half extents scaled to 1.
/// The directions have z = 1 in the camera frame, so distances along them are depths.
struct Target {
  Eigen::Vector3f origin;
  Eigen::Vector3f first;
  Eigen::Vector3f per_column;
  Eigen::Vector3f per_row;
  int x_begin = 0;
  int x_end = 0;
  int y_begin = 0;
  int y_end = 0;
};

/// Part of the image that can show the solid: the bounds of its projected corners.
void bound(const Solid& solid, const CameraIntrinsics& k, const Eigen::Isometry3f& T_camera_room,
           Target& target) {
  Eigen::AlignedBox2f box;
  bool in_front = true;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f signs((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F,
                                (corner & 4) != 0 ? 1.0F : -1.0F);
    const Eigen::Vector3f p =
        T_camera_room * (solid.T_room_solid * Eigen::Vector3f(signs.cwiseProduct(solid.half)));
    in_front = in_front && p.z() > 0.01F;
    const Eigen::Vector2f focal(static_cast<float>(k.fx), static_cast<float>(k.fy));
    const Eigen::Vector2f center(static_cast<float>(k.cx), static_cast<float>(k.cy));
    box.extend(Eigen::Vector2f(focal.cwiseProduct(p.head<2>() / p.z()) + center));
  }
  const auto clamped = [](float value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0F, static_cast<float>(limit)));
  };
  target.x_begin = in_front ? clamped(std::floor(box.min().x()), k.width) : 0;
  target.x_end = in_front ? clamped(std::ceil(box.max().x()) + 1.0F, k.width) : k.width;
  target.y_begin = in_front ? clamped(std::floor(box.min().y()), k.height) : 0;
  target.y_end = in_front ? clamped(std::ceil(box.max().y()) + 1.0F, k.height) : k.height;
}

Target target_of(const Solid& solid, const CameraIntrinsics& k,
                 const Eigen::Isometry3f& T_room_camera) {
  const Eigen::Isometry3f T_solid_camera = solid.T_room_solid.inverse() * T_room_camera;
  const Eigen::Matrix3f scaled = solid.half.cwiseInverse().asDiagonal() * T_solid_camera.linear();
  const auto ray = [&](double x, double y) {
    return Eigen::Vector3f(static_cast<float>((x - k.cx) / k.fx),
                           static_cast<float>((y - k.cy) / k.fy), 1.0F);
  };
  Target target;
  target.origin = T_solid_camera.translation().cwiseQuotient(solid.half);
  target.first = scaled * ray(0.0, 0.0);
  target.per_column = scaled * (ray(1.0, 0.0) - ray(0.0, 0.0));
  target.per_row = scaled * (ray(0.0, 1.0) - ray(0.0, 0.0));
  bound(solid, k, T_room_camera.inverse(), target);
  return target;
}

// Both give the depth at which the ray enters the unit shape, or leaves it when it starts inside,
// and infinity when it misses. Lambdas and not functions, so that the loop over a row inlines them.
constexpr auto hit_box = [](const Eigen::Vector3f& o, float dx, float dy, float dz) {
  const float ix = 1.0F / dx;
  const float iy = 1.0F / dy;
  const float iz = 1.0F / dz;
  const float mx = -o.x() * ix;
  const float my = -o.y() * iy;
  const float mz = -o.z() * iz;
  const float enter = std::max({mx - std::abs(ix), my - std::abs(iy), mz - std::abs(iz)});
  const float leave = std::min({mx + std::abs(ix), my + std::abs(iy), mz + std::abs(iz)});
  if (enter > leave || leave <= 0.0F) return kInfinity;
  return enter > 0.0F ? enter : leave;
};

constexpr auto hit_ball = [](const Eigen::Vector3f& o, float dx, float dy, float dz) {
  const float a = dx * dx + dy * dy + dz * dz;
  const float b = o.x() * dx + o.y() * dy + o.z() * dz;
  const float root = b * b - a * (o.squaredNorm() - 1.0F);
  if (root < 0.0F) return kInfinity;
  const float enter = (-b - std::sqrt(root)) / a;
  const float leave = (-b + std::sqrt(root)) / a;
  if (leave <= 0.0F) return kInfinity;
  return enter > 0.0F ? enter : leave;
};

template <class Hit>
void cast_row(const Target& target, int y, std::int32_t index, float* depth, std::int32_t* solid,
              const Hit& hit) {
  const Eigen::Vector3f start = target.first + static_cast<float>(y) * target.per_row;
  const Eigen::Vector3f step = target.per_column;
  for (int x = target.x_begin; x < target.x_end; ++x) {
    const auto column = static_cast<float>(x);
    const float t = hit(target.origin, start.x() + column * step.x(), start.y() + column * step.y(),
                        start.z() + column * step.z());
    if (!(t < depth[x])) continue;
    depth[x] = t;
    solid[x] = index;
  }
}

}  // namespace

CastImage cast_rays(const std::vector<Solid>& solids, const CameraIntrinsics& camera,
                    const Eigen::Isometry3d& T_room_camera) {
  std::vector<Target> targets;
  for (const Solid& solid : solids) {
    targets.push_back(target_of(solid, camera, T_room_camera.cast<float>()));
  }
  CastImage image{Image<float>(camera.width, camera.height, kInfinity),
                  Image<std::int32_t>(camera.width, camera.height, -1)};
  const auto cast = [&](std::size_t i, int y) {
    const auto index = static_cast<std::int32_t>(i);
    float* depth = image.depth.row(y);
    std::int32_t* solid = image.solid.row(y);
    solids[i].shape == Shape::kBox ? cast_row(targets[i], y, index, depth, solid, hit_box)
                                   : cast_row(targets[i], y, index, depth, solid, hit_ball);
  };
  parallel_chunks(static_cast<std::size_t>(camera.height), 16, [&](auto begin, auto end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (std::size_t i = 0; i < targets.size(); ++i) {
        if (y >= targets[i].y_begin && y < targets[i].y_end) cast(i, y);
      }
    }
  });
  return image;
}

}  // namespace mms
