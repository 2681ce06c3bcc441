#include "mms/simulation/world/lidar_scan.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/hash_noise.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

/// Beams within one slice of time see the scene at the slice's center; a walker's legs move less
/// than 1 cm in that time.
constexpr double kSlice = 0.005;  // [s]

struct Echo {
  float range = 0.0F;  ///< 0 for none [m]
  float intensity = 0.0F;
};

Echo echo_of(const Stage& stage, const Ray& ray, const RayHit& hit, const LidarSensor& sensor,
             bool noise, std::uint64_t hash) {
  if (!hit.valid()) return {};
  const SurfacePoint point = stage.surface(ray, hit);
  const float cosine = std::abs(point.face_normal.dot(ray.direction));
  const float reflectance = std::min(1.0F, point.material->color.mean());
  const bool in_range = hit.distance >= static_cast<float>(sensor.min_range) &&
                        hit.distance <= static_cast<float>(sensor.max_range);
  const float ideal = in_range ? hit.distance : 0.0F;
  const float range =
      noise ? measured_range(hit.distance, cosine, reflectance, point.material->gloss, sensor, hash)
            : ideal;
  return {range, reflectance * cosine};
}

}  // namespace

ExactScan scan(Stage& stage, const LidarSensor& sensor, int index, double period,
               const std::function<Eigen::Isometry3d(double)>& T_building_lidar, double start,
               bool noise, std::uint64_t key) {
  const std::vector<Beam> shots = beams(sensor, index, period);
  std::vector<Echo> echoes(shots.size());
  std::vector<Ray> rays(shots.size());
  std::vector<RayHit> hits(shots.size());
  for (std::size_t first = 0; first < shots.size();) {
    const double begin = static_cast<double>(shots[first].time_offset);
    std::size_t last = first;
    while (last < shots.size() && static_cast<double>(shots[last].time_offset) < begin + kSlice) {
      ++last;
    }
    stage.set(start + begin + 0.5 * kSlice);
    parallel_chunks(last - first, 256, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = first + from; i < first + to; ++i) {
        const Eigen::Isometry3f T =
            T_building_lidar(static_cast<double>(shots[i].time_offset)).cast<float>();
        rays[i] = {T.translation(), T.linear() * shots[i].direction};
      }
      const std::size_t count = to - from;
      stage.rays().cast(std::span(rays).subspan(first + from, count),
                        std::span(hits).subspan(first + from, count));
      for (std::size_t i = first + from; i < first + to; ++i) {
        echoes[i] = echo_of(stage, rays[i], hits[i], sensor, noise, hash_of(key, i));
      }
    });
    first = last;
  }
  ExactScan result;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (echoes[i].range <= 0.0F) continue;
    result.scan.points.push_back(echoes[i].range * shots[i].direction);
    result.scan.intensity.push_back(echoes[i].intensity);
    result.scan.time_offset.push_back(shots[i].time_offset);
    result.points.push_back(rays[i].origin + hits[i].distance * rays[i].direction);
    result.labels.push_back(stage.object_of(hits[i]));
  }
  return result;
}

}  // namespace mms
