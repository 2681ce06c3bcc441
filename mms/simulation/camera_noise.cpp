#include "mms/simulation/camera_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mms/geometry/parallel.hpp"
#include "mms/simulation/hash_noise.hpp"
#include "mms/simulation/shading.hpp"

namespace mms {
namespace {

constexpr float kMinDepth = 0.4F;  // [m]

float sigma(float z) {
  return 0.0012F + 0.0019F * (z - 0.4F) * (z - 0.4F);
}

/// Depth near (x, y) that is the farthest from its own, where that is a jump; else its own.
float across_rim(const Image<float>& depth, int x, int y) {
  constexpr int kReach = 2;
  const float z = depth(x, y);
  if (x < kReach || y < kReach || x + kReach >= depth.width() || y + kReach >= depth.height()) {
    return z;
  }
  const float* here = depth.row(y) + x;
  float lowest = z;
  float highest = z;
  for (const std::ptrdiff_t step : {1, depth.width()}) {
    for (std::ptrdiff_t d = -kReach; d <= kReach; ++d) {
      lowest = std::min(lowest, here[d * step]);
      highest = std::max(highest, here[d * step]);
    }
  }
  const float other = highest - z > z - lowest ? highest : lowest;
  return std::abs(other - z) > 0.06F * z ? other : z;
}

/// Share of measurements lost to the angle between ray and surface.
float loss_at(float cosine) {
  return std::clamp((0.22F - cosine) / 0.12F, 0.0F, 1.0F);
}

/// What becomes of an exact depth; `hash` decides.
float disturbed(float z, float beside, float cosine, std::uint64_t hash) {
  const float chance = uniform_of(hash);
  if (chance < loss_at(cosine)) return 0.0F;
  if (beside != z) {
    if (chance < 0.5F) return 0.0F;
    if (chance < 0.65F) z += (beside - z) * uniform_of(hash_of(hash, 1));
  }
  return z + sigma(z) * normal_of(hash_of(hash, 2));
}

}  // namespace

Image<float> measured_depth(const CastImage& cast, const std::vector<Solid>& solids,
                            const CameraIntrinsics& camera, const Eigen::Isometry3d& T_room_camera,
                            double max_depth, std::uint64_t key) {
  const Eigen::Isometry3f T = T_room_camera.cast<float>();
  const auto limit = static_cast<float>(max_depth);
  Image<float> measured(camera.width, camera.height);
  const auto pixel = [&](int x, int y) {
    const float z = cast.depth(x, y);
    if (!(z >= kMinDepth && z <= limit)) return 0.0F;
    const Eigen::Vector3f ray(static_cast<float>((x - camera.cx) / camera.fx),
                              static_cast<float>((y - camera.cy) / camera.fy), 1.0F);
    const Solid& solid = solids[static_cast<std::size_t>(cast.solid(x, y))];
    const Eigen::Vector3f normal = surface_normal(solid, T * Eigen::Vector3f(z * ray));
    const float cosine = std::abs(normal.dot(T.linear() * ray)) / ray.norm();
    const auto index = static_cast<std::uint64_t>(y) * 65536 + static_cast<std::uint64_t>(x);
    return disturbed(z, across_rim(cast.depth, x, y), cosine, hash_of(key, index));
  };
  parallel_chunks(static_cast<std::size_t>(camera.height), 16, [&](auto begin, auto end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < camera.width; ++x) measured(x, y) = pixel(x, y);
    }
  });
  return measured;
}

void add_color_noise(Image<Rgb>& image, double sigma, std::uint64_t key) {
  const auto level = static_cast<float>(sigma);
  const auto noisy = [&](std::uint8_t value, std::uint64_t hash) {
    const float sum = static_cast<float>(value) + level * normal_of(hash) + 0.5F;
    return static_cast<std::uint8_t>(std::clamp(sum, 0.0F, 255.0F));
  };
  parallel_chunks(image.size(), 8192, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t hash = hash_of(key, i);
      Rgb& color = image[i];
      color = {noisy(color.r, hash), noisy(color.g, hash_of(hash)), noisy(color.b, hash_of(~hash))};
    }
  });
}

}  // namespace mms
