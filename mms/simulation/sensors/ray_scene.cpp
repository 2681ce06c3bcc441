#include "mms/simulation/sensors/ray_scene.hpp"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kPacket = 8;
constexpr float kNear = 1e-4F;  // in lengths of the direction

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using Scene = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

void check(RTCDevice device) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  throw Error(
      "simulation", "Embree failed with error " + std::to_string(static_cast<int>(code)),
      code == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory" : "is the CPU x86-64 or ARM64?");
}

/// Builds on one thread: with more, the tree and the winner of a tie would be random.
void commit(RTCScene scene) {
  tbb::task_arena arena(1);
  arena.execute([&] { rtcJoinCommitScene(scene); });
}

Geometry triangles_of(RTCDevice device, const Mesh& mesh) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), mesh.vertices.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  check(device);
  for (const Vertex& vertex : mesh.vertices) {
    positions = std::copy_n(vertex.position.data(), 3, positions);
  }
  for (const Triangle& triangle : mesh.triangles) {
    corners = std::copy_n(triangle.corners.data(), 3, corners);
  }
  rtcCommitGeometry(geometry.get());
  return geometry;
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context{};
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Sets one lane of a packet.
void load(const Ray& ray, RTCRay8& packet, std::size_t lane) {
  packet.org_x[lane] = ray.origin.x();
  packet.org_y[lane] = ray.origin.y();
  packet.org_z[lane] = ray.origin.z();
  packet.dir_x[lane] = ray.direction.x();
  packet.dir_y[lane] = ray.direction.y();
  packet.dir_z[lane] = ray.direction.z();
  packet.tnear[lane] = kNear;
  packet.tfar[lane] = ray.reach;
  packet.time[lane] = 0.0F;
  packet.mask[lane] = ~0U;
  packet.id[lane] = 0;
  packet.flags[lane] = 0;
}

/// Loads up to one packet of rays; unused lanes are disabled.
std::size_t load(std::span<const Ray> rays, RTCRay8& packet, int* valid) {
  const std::size_t count = std::min(kPacket, rays.size());
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    load(rays[std::min(lane, count - 1)], packet, lane);
    valid[lane] = lane < count ? -1 : 0;
  }
  return count;
}

}  // namespace

struct RayScene::Impl {
  Device device{rtcNewDevice(nullptr)};
  Scene all;
  std::vector<Scene> shapes;        ///< of the fixed mesh, which is built only once, and the parts
  std::vector<Geometry> instances;  ///< one per part, with geometry id 1 + part in `all`

  Scene new_scene() const {
    Scene scene(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    return scene;
  }

  Geometry add_shape(const Mesh& mesh, unsigned id) {
    Scene shape = new_scene();
    rtcAttachGeometryByID(shape.get(), triangles_of(device.get(), mesh).get(), 0);
    commit(shape.get());
    Geometry instance(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instance.get(), shape.get());
    rtcSetGeometryTimeStepCount(instance.get(), 1);
    rtcCommitGeometry(instance.get());
    shapes.push_back(std::move(shape));
    rtcAttachGeometryByID(all.get(), instance.get(), id);
    return instance;
  }

  void add_part(const Mesh& mesh) {
    const auto id = static_cast<unsigned>(1 + instances.size());
    instances.push_back(add_shape(mesh, id));
  }

  void cast(RTCScene scene, std::span<const Ray> rays, std::span<RayHit> hits) const {
    RTCIntersectContext context = coherent_context();
    alignas(32) RTCRayHit8 packet{};
    alignas(32) int valid[kPacket];
    for (std::size_t i = 0; i < rays.size(); i += kPacket) {
      const std::size_t count = load(rays.subspan(i), packet.ray, valid);
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(valid, scene, &context, &packet);
      for (std::size_t lane = 0; lane < count; ++lane) hits[i + lane] = hit_of(packet, lane);
    }
  }

  static RayHit hit_of(const RTCRayHit8& packet, std::size_t lane) {
    if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
    return {packet.ray.tfar[lane], static_cast<std::int32_t>(packet.hit.instID[0][lane]),
            packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane]};
  }
};

RayScene::RayScene(const Mesh& fixed, std::span<const Mesh* const> parts)
    : impl_(std::make_unique<Impl>()) {
  check(impl_->device.get());
  impl_->all = impl_->new_scene();
  impl_->add_shape(fixed, 0);
  for (const Mesh* part : parts) impl_->add_part(*part);
  place(std::vector<Eigen::Isometry3f>(parts.size(), Eigen::Isometry3f::Identity()));
}

RayScene::~RayScene() = default;

std::size_t RayScene::part_count() const {
  return impl_->instances.size();
}

void RayScene::place(std::span<const Eigen::Isometry3f> T_world_part) {
  if (T_world_part.size() != part_count()) {
    throw Error("simulation", "got " + std::to_string(T_world_part.size()) + " poses for " +
                                  std::to_string(part_count()) + " parts");
  }
  for (std::size_t i = 0; i < T_world_part.size(); ++i) {
    RTCGeometry instance = impl_->instances[i].get();
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                            T_world_part[i].matrix().data());
    rtcCommitGeometry(instance);
  }
  commit(impl_->all.get());
  check(impl_->device.get());
}

void RayScene::cast(std::span<const Ray> rays, std::span<RayHit> hits) const {
  impl_->cast(impl_->all.get(), rays, hits);
}

void RayScene::cast_at_parts(std::span<const Ray> rays, std::size_t first, std::size_t last,
                             std::span<RayHit> hits) const {
  Scene alone = impl_->new_scene();
  for (std::size_t i = first; i < last; ++i) {
    rtcAttachGeometryByID(alone.get(), impl_->instances[i].get(), static_cast<unsigned>(1 + i));
  }
  commit(alone.get());
  impl_->cast(alone.get(), rays, hits);
}

void RayScene::blocked(std::span<const Ray> rays, std::span<std::uint8_t> result) const {
  RTCIntersectContext context = coherent_context();
  alignas(32) RTCRay8 packet{};
  alignas(32) int valid[kPacket];
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    const std::size_t count = load(rays.subspan(i), packet, valid);
    rtcOccluded8(valid, impl_->all.get(), &context, &packet);
    for (std::size_t lane = 0; lane < count; ++lane) {
      result[i + lane] = packet.tfar[lane] < 0.0F ? 1 : 0;
    }
  }
}

}  // namespace mms
