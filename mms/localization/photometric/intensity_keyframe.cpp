#include "mms/localization/photometric/intensity_keyframe.hpp"

#include <algorithm>
#include <cmath>

#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

/// [px]: half width of the depth average. Source: initial choice; 25 pixels reduce the noise of a
/// depth to a fifth, as far as it is independent.
constexpr int kDepthWindow = 2;

/// [px]: pixels left out at the image border. Source: kDepthWindow.
constexpr int kBorder = 2;

/// [-]: depth over lateral offset of the steepest surface, 72 degrees from frontal.
/// Source: initial choice, not tuned since.
constexpr float kMaxSlope = 3.0F;

/// [-]: depth noise between pixels of one surface, in sigmas.
/// Source: initial choice; more than three, since one of 24 pixels beyond it rejects the point.
constexpr float kDepthSigmas = 4.0F;

/// [-]: valid pixels of the depth average, of 25.
/// Source: initial choice; a third, so that pixels beside holes are kept.
constexpr int kMinValidPixels = 8;

/// Mean depth of the pixels around (x, y) on the same surface; 0 at depth discontinuities, where
/// the depth at the pixel may be another surface's.
float surface_depth(const Image<float>& depth, int x, int y, const DepthNoise& noise,
                    double focal) {
  const float centre = depth(x, y);
  if (centre <= 0.0F) return 0.0F;
  const float slope = kMaxSlope * centre / static_cast<float>(focal) * kDepthWindow;
  const float gate = kDepthSigmas * noise.sigma(centre) + slope;
  float sum = 0.0F;
  int count = 0;
  for (int dy = -kDepthWindow; dy <= kDepthWindow; ++dy) {
    for (int dx = -kDepthWindow; dx <= kDepthWindow; ++dx) {
      if (!depth.contains(x + dx, y + dy)) continue;
      const float d = depth(x + dx, y + dy);
      if (d <= 0.0F) continue;
      if (std::abs(d - centre) > gate) return 0.0F;
      sum += 1.0F / d;
      ++count;
    }
  }
  return count >= kMinValidPixels ? static_cast<float>(count) / sum : 0.0F;
}

std::vector<TexturedPoint> textured_points(const IntensityLevel& level,
                                           const PhotometricConfig& config,
                                           const DepthNoise& noise) {
  const CameraModel camera(level.camera);
  const auto min_square = static_cast<float>(config.min_gradient * config.min_gradient);
  const int side = config.cell_px;
  std::vector<TexturedPoint> points;
  for (int top = kBorder; top < level.camera.height - kBorder; top += side) {
    for (int left = kBorder; left < level.camera.width - kBorder; left += side) {
      float strongest = min_square;
      int best_x = -1;
      int best_y = -1;
      for (int y = top; y < std::min(top + side, level.camera.height - kBorder); ++y) {
        for (int x = left; x < std::min(left + side, level.camera.width - kBorder); ++x) {
          const IntensitySample& s = level.intensity(x, y);
          const float square = s.dx * s.dx + s.dy * s.dy;
          if (square <= strongest || level.depth(x, y) <= 0.0F) continue;
          strongest = square;
          best_x = x;
          best_y = y;
        }
      }
      if (best_x < 0) continue;
      const float z = surface_depth(level.depth, best_x, best_y, noise, level.camera.fx);
      if (z <= 0.0F) continue;
      const Eigen::Vector3f ray = camera.ray({best_x, best_y}).cast<float>();
      points.push_back({z * ray, level.intensity(best_x, best_y).value});
    }
  }
  return points;
}

double harmonic_depth(const std::vector<std::vector<TexturedPoint>>& levels) {
  if (levels.empty() || levels.front().empty()) return IntensityKeyframe{}.depth;
  double inverse = 0.0;
  for (const TexturedPoint& p : levels.front()) inverse += 1.0 / static_cast<double>(p.point.z());
  return static_cast<double>(levels.front().size()) / inverse;
}

}  // namespace

IntensityKeyframe make_intensity_keyframe(const std::vector<IntensityLevel>& levels,
                                          const Eigen::Isometry3d& T_world_sensor,
                                          const PhotometricConfig& config,
                                          const DepthNoise& noise) {
  IntensityKeyframe keyframe;
  keyframe.T_world_sensor = T_world_sensor;
  for (const IntensityLevel& level : levels) {
    keyframe.levels.push_back(textured_points(level, config, noise));
  }
  keyframe.depth = harmonic_depth(keyframe.levels);
  return keyframe;
}

}  // namespace mms
