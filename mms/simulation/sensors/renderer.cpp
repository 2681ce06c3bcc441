#include "mms/simulation/sensors/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "mms/geometry/camera.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

constexpr std::size_t kRun = 64;      // pixels traced together, a multiple of Embree's packet size
constexpr float kShadowStep = 2e-3F;  // offset of shadow rays from the surface [m]

Ray ray_of(const RayTable& table, std::size_t i, const Eigen::Isometry3f& T_world_camera) {
  return {T_world_camera.translation(), T_world_camera.linear() * table.rays[i]};
}

/// Specular highlight of a lamp (Blinn-Phong).
float highlight(const SurfacePoint& point, const Eigen::Vector3f& to_eye,
                const Eigen::Vector3f& to_lamp) {
  const Eigen::Vector3f half = (to_eye + to_lamp.normalized()).normalized();
  const float c = std::max(0.0F, half.dot(point.normal));
  const float c2 = c * c;
  const float c8 = c2 * c2 * c2 * c2;
  return 2.5F * point.material->gloss * c8 * c8 * c8;
}

/// State of a run of pixels during casting, shadows and shading.
struct Run {
  std::array<Ray, kRun> rays;
  std::array<RayHit, kRun> hits;
  std::array<SurfacePoint, kRun> points;
  std::array<LocalLight, kRun> light;
  std::array<Ray, kRun> shadow_rays;
  std::array<std::uint8_t, kRun> shadowed{};
};

/// Removes the light of lamp number `lamp` at occluded points.
void cast_shadows(const RayScene& scene, std::size_t lamp, std::size_t count, Run& run) {
  for (std::size_t i = 0; i < count; ++i) {
    Ray& ray = run.shadow_rays[i];
    if (!run.hits[i].valid()) {
      ray.reach = 0.0F;
      ray.origin.setZero();
      ray.direction = Eigen::Vector3f::UnitZ();
      continue;
    }
    const LampLight& light = run.light[i].lamps[lamp];
    const bool lit =
        light.irradiance.x() > 0.0F && light.to_lamp.dot(run.points[i].face_normal) > 0.0F;
    ray.origin = run.points[i].position + kShadowStep * run.points[i].face_normal;
    ray.direction = light.to_lamp;
    ray.reach = lit ? 0.98F : 0.0F;
  }
  scene.blocked(std::span(run.shadow_rays).first(count), std::span(run.shadowed).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    if (!run.hits[i].valid()) continue;
    if (run.shadowed[i] != 0 || run.shadow_rays[i].reach == 0.0F) {
      run.light[i].lamps[lamp].irradiance.setZero();
    }
  }
}

Eigen::Vector3f shade(const Run& run, std::size_t i, float pixel_angle) {
  if (!run.hits[i].valid()) return {0.02F, 0.02F, 0.025F};
  const SurfacePoint& point = run.points[i];
  const Eigen::Vector3f to_eye = -run.rays[i].direction.normalized();
  const float distance = run.hits[i].distance;
  const float cosine = std::max(0.1F, std::abs(to_eye.dot(point.face_normal)));
  const float footprint = distance * pixel_angle / std::sqrt(cosine);
  const Eigen::Vector3f color = albedo(*point.material, point.uv.x(), point.uv.y(), footprint);
  Eigen::Vector3f light = run.light[i].rest;
  Eigen::Vector3f mirrored = Eigen::Vector3f::Zero();
  for (const LampLight& lamp : run.light[i].lamps) {
    light += lamp.irradiance;
    if (point.material->gloss > 0.0F && lamp.irradiance.x() > 0.0F) {
      mirrored += highlight(point, to_eye, lamp.to_lamp) * lamp.irradiance;
    }
  }
  // Material colors are in display space; light is added in linear space.
  return color.cwiseMax(0.0F).cwiseProduct(color.cwiseMax(0.0F)).cwiseProduct(light) + mirrored;
}

void cast_run(const RayScene& scene, const SurfaceLookup& surfaces, const RayTable& table,
              const Eigen::Isometry3f& T, std::size_t first, std::size_t count, Run& run) {
  for (std::size_t i = 0; i < count; ++i) run.rays[i] = ray_of(table, first + i, T);
  scene.cast(std::span(run.rays).first(count), std::span(run.hits).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    if (run.hits[i].valid()) run.points[i] = surfaces.at(run.rays[i], run.hits[i]);
  }
}

void light_run(const RayScene& scene, const Lights& lights, std::size_t count, Run& run) {
  for (std::size_t i = 0; i < count; ++i) {
    if (run.hits[i].valid()) {
      run.light[i] = light_at(lights, run.points[i].position, run.points[i].normal);
    }
  }
  for (std::size_t lamp = 0; lamp < kShadowLamps; ++lamp) cast_shadows(scene, lamp, count, run);
}

ExactView empty_view(const RayTable& table) {
  ExactView view;
  view.depth = {table.width, table.height, std::numeric_limits<float>::infinity()};
  view.cosine = {table.width, table.height};
  view.reflectance = {table.width, table.height};
  view.gloss = {table.width, table.height};
  view.object = {table.width, table.height};
  return view;
}

void write_view(const Run& run, const std::vector<std::uint8_t>& object_of_part, std::size_t first,
                std::size_t count, ExactView& view) {
  for (std::size_t i = 0; i < count; ++i) {
    const RayHit& hit = run.hits[i];
    if (!hit.valid()) continue;
    const SurfacePoint& point = run.points[i];
    const Eigen::Vector3f& ray = run.rays[i].direction;
    view.depth[first + i] = hit.distance;
    view.cosine[first + i] = std::abs(point.face_normal.dot(ray)) / ray.norm();
    view.reflectance[first + i] = point.material->color.mean();
    view.gloss[first + i] = point.material->gloss;
    if (hit.part > 0) {
      view.object[first + i] = object_of_part[static_cast<std::size_t>(hit.part - 1)];
    }
  }
}

}  // namespace

SurfaceLookup::SurfaceLookup(const Mesh& fixed, std::vector<const Mesh*> parts)
    : fixed_(fixed), parts_(std::move(parts)), T_(parts_.size(), Eigen::Isometry3f::Identity()) {}

SurfacePoint SurfaceLookup::at(const Ray& ray, const RayHit& hit) const {
  const auto part = static_cast<std::size_t>(hit.part);
  const Mesh& mesh = part == 0 ? fixed_ : *parts_[part - 1];
  const Triangle& triangle = mesh.triangles[hit.triangle];
  const Vertex& a = mesh.vertices[triangle.corners[0]];
  const Vertex& b = mesh.vertices[triangle.corners[1]];
  const Vertex& c = mesh.vertices[triangle.corners[2]];
  const float w = 1.0F - hit.u - hit.v;
  SurfacePoint point;
  point.material = &mesh.materials[triangle.material];
  point.position = ray.origin + hit.distance * ray.direction;
  point.uv = w * a.uv + hit.u * b.uv + hit.v * c.uv;
  point.normal = (w * a.normal + hit.u * b.normal + hit.v * c.normal).normalized();
  point.face_normal = (b.position - a.position).cross(c.position - a.position).normalized();
  if (part != 0) {
    point.normal = T_[part - 1].linear() * point.normal;
    point.face_normal = T_[part - 1].linear() * point.face_normal;
  }
  if (point.face_normal.dot(ray.direction) > 0.0F) point.face_normal = -point.face_normal;
  if (point.normal.dot(point.face_normal) < 0.0F) point.normal = -point.normal;
  return point;
}

RayTable ray_table(const CameraIntrinsics& camera) {
  return {camera.width, camera.height, static_cast<float>(1.0 / camera.fx),
          CameraModel(camera).ray_table()};
}

void render(const RayScene& scene, const SurfaceLookup& surfaces, const Lights& lights,
            const std::vector<std::uint8_t>& object_of_part, const RayTable& table,
            const Eigen::Isometry3f& T_world_camera, const RenderTarget& target) {
  if (target.view != nullptr) *target.view = empty_view(table);
  parallel_chunks(table.rays.size(), 16 * kRun, [&](std::size_t begin, std::size_t end) {
    Run run;
    for (std::size_t first = begin; first < end; first += kRun) {
      const std::size_t count = std::min(kRun, end - first);
      cast_run(scene, surfaces, table, T_world_camera, first, count, run);
      if (target.view != nullptr) write_view(run, object_of_part, first, count, *target.view);
      if (target.radiance == nullptr) continue;
      light_run(scene, lights, count, run);
      for (std::size_t i = 0; i < count; ++i) {
        (*target.radiance)[first + i] += target.weight * shade(run, i, table.pixel_angle);
      }
    }
  });
}

}  // namespace mms
