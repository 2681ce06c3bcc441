#include "mms/simulation/sensors/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "mms/core/hash_noise.hpp"
#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

constexpr std::size_t kRowsAtOnce = 16;
constexpr float kJump = 0.06F;      // relative jump of inverse depth at a boundary
constexpr float kMaxGrowth = 4.0F;  // largest factor of sigma at grazing angles
constexpr int kMaxReach = 8;        // [px]

/// Inverse depths [1/m] with a margin of NaN, which never compares as a jump; 0 without surface. On
/// a plane they are linear in the pixel, which distinguishes jumps from slopes.
class InverseDepth {
 public:
  InverseDepth(const Image<float>& depth, int margin)
      : margin_(margin),
        image_(depth.width() + 2 * margin, depth.height() + 2 * margin,
               std::numeric_limits<float>::quiet_NaN()) {
    parallel_chunks(static_cast<std::size_t>(depth.height()), kRowsAtOnce,
                    [&](auto begin, auto end) {
                      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
                        const float* from = depth.row(y);
                        float* to = image_.row(y + margin_) + margin_;
                        for (int x = 0; x < depth.width(); ++x)
                          to[x] = from[x] > 0.0F ? 1.0F / from[x] : 0.0F;
                      }
                    });
  }

  const float* row(int y) const { return image_.row(y + margin_) + margin_; }
  std::ptrdiff_t stride() const { return image_.width(); }

 private:
  int margin_;
  Image<float> image_;
};

/// For every pixel of a row the inverse depth across the largest jump among those `step` away, if
/// it is larger than the one in `beyond`.
void find_jumps(const float* here, std::ptrdiff_t step, int width, float* beyond) {
  for (int x = 0; x < width; ++x) {
    const float d = here[x];
    const float other = here[x + step];
    const float limit = kJump * std::max(d, other);
    const float jump = std::abs(other - d);
    const float bend = std::abs(other - 2.0F * d + here[x - step]);
    const bool boundary = (jump > limit) & (bend > limit);
    beyond[x] = (boundary & (jump > std::abs(beyond[x] - d))) ? other : beyond[x];
  }
}

/// Inverse depths across the boundary for the pixels of row `y`: their own away from boundaries.
void find_boundaries(const InverseDepth& inverse, int y, int reach, std::vector<float>& beyond) {
  const float* here = inverse.row(y);
  const int width = static_cast<int>(beyond.size());
  std::copy(here, here + width, beyond.begin());
  for (std::ptrdiff_t distance = 1; distance <= reach; ++distance) {
    for (const std::ptrdiff_t way : {std::ptrdiff_t{1}, inverse.stride()}) {
      find_jumps(here, distance * way, width, beyond.data());
      find_jumps(here, -distance * way, width, beyond.data());
    }
  }
}

/// Exact surface at a pixel.
struct Surface {
  float z = 0.0F;  // [m]
  float beyond =
      0.0F;  // depth across the boundary [m], infinite without surface; z away from boundaries
  float cosine = 0.0F;
  float reflectance = 0.0F;
  float gloss = 0.0F;
};

/// A DepthSensor in single precision, with derived values.
class Measurement {
 public:
  explicit Measurement(const DepthSensor& sensor)
      : noise_(sensor.noise),
        growth_(static_cast<float>(sensor.grazing_growth)),
        min_(static_cast<float>(sensor.min_range)),
        max_(static_cast<float>(sensor.max_range)),
        by_disparity_(sensor.quantisation == DepthQuantisation::kDisparity),
        step_(static_cast<float>(sensor.step)),
        lost_cosine_(static_cast<float>(std::max(sensor.lost_cosine, 1e-6))),
        darkness_(static_cast<float>(sensor.lost_darkness / (sensor.max_range * sensor.max_range))),
        boundary_lost_(static_cast<float>(sensor.boundary_lost)),
        boundary_mixed_(static_cast<float>(sensor.boundary_mixed)) {}

  /// Measured depth, 0 for no return; deterministic for a `hash`.
  float operator()(const Surface& s, std::uint64_t hash) const {
    if (!in_range(s.z) || uniform_of(hash) < lost(s)) return 0.0F;
    float z = s.z;
    if (s.beyond != s.z) {
      const float chance = uniform_of(hash_of(hash, 1));
      if (chance < boundary_lost_) return 0.0F;
      if (chance < boundary_lost_ + boundary_mixed_)
        z += (s.beyond - z) * uniform_of(hash_of(hash, 2));
    }
    if (!in_range(z)) return 0.0F;
    z = quantised(z + sigma(z, s.cosine) * normal_of(hash_of(hash)));
    return in_range(z) ? z : 0.0F;
  }

 private:
  bool in_range(float z) const { return z >= min_ && z <= max_; }

  float sigma(float z, float cosine) const {
    const float growth = 1.0F + growth_ * (1.0F / std::max(cosine, 1e-3F) - 1.0F);
    return noise_.sigma(z) * std::min(growth, kMaxGrowth);
  }

  /// Probability that too little light returns.
  float lost(const Surface& s) const {
    const float grazing = (3.0F * lost_cosine_ - s.cosine) / (2.0F * lost_cosine_);
    const float needed = darkness_ * s.z * s.z;
    const float dark = needed > 0.0F ? 2.0F - s.reflectance / needed : 0.0F;
    const float away = std::clamp((0.95F - s.cosine) * 4.0F, 0.0F, 1.0F);
    return std::max({grazing, dark, s.gloss * s.gloss * away});
  }

  float quantised(float z) const {
    if (!(step_ > 0.0F)) return z;
    if (!by_disparity_) return std::round(z / step_) * step_;
    return 1.0F / (std::round(1.0F / (z * step_)) * step_);
  }

  DepthNoise noise_;
  float growth_;
  float min_;  // [m]
  float max_;  // [m]
  bool by_disparity_;
  float step_;
  float lost_cosine_;
  float darkness_;  // reflectance needed at 1 m
  float boundary_lost_;
  float boundary_mixed_;
};

/// `value`, or 0 if NaN or negative.
float sane(float value) {
  return value > 0.0F ? value : 0.0F;
}

}  // namespace

Image<float> measured_depth(const ExactView& view, const DepthSensor& sensor, std::uint64_t key) {
  const int width = view.depth.width();
  const int reach = std::clamp(sensor.boundary_reach, 0, kMaxReach);
  const InverseDepth inverse(view.depth, reach);
  const Measurement measure(sensor);
  const std::uint64_t stream = hash_of(key);
  Image<float> measured(width, view.depth.height());
  const auto pixel = [&](std::size_t i, float own, float beyond) {
    const float z = view.depth[i];
    const Surface surface{z, beyond == own ? z : 1.0F / beyond, sane(view.cosine[i]),
                          sane(view.reflectance[i]), sane(view.gloss[i])};
    return measure(surface, hash_of(stream + i));
  };
  parallel_chunks(static_cast<std::size_t>(view.depth.height()), kRowsAtOnce,
                  [&](auto begin, auto end) {
                    std::vector<float> beyond(static_cast<std::size_t>(width));
                    for (std::size_t y = begin; y < end; ++y) {
                      find_boundaries(inverse, static_cast<int>(y), reach, beyond);
                      const float* own = inverse.row(static_cast<int>(y));
                      const std::size_t first = y * beyond.size();
                      for (std::size_t x = 0; x < beyond.size(); ++x) {
                        measured[first + x] = pixel(first + x, own[x], beyond[x]);
                      }
                    }
                  });
  return measured;
}

}  // namespace mms
