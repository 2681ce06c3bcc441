#include "mms/global_map/keyframes/view_texture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

/// [px]: pixels of a patch on each side of its center. Source: 28 cm at 3 m, as a label or a mark.
constexpr int kPatchRadius = 3;

/// [px]: distance of the centers of patches. Source: half of them overlap; computing time.
constexpr int kStep = 2;

/// [-]: pixels of a patch on shared surfaces, at least. Source: initial choice, 60 %.
constexpr float kMinPixels = 29.0F;

/// [grey levels]: least standard deviation of a patch. Source: noise of a camera, averaged over a
/// pixel of a view.
constexpr float kMinContrast = 2.0F;

/// [grey levels]: largest one. Source: structures that repeat, as posts and labels on equal boxes,
/// have more; in racks of one kind their patches agree at wrong places.
constexpr float kMaxContrast = 8.0F;

/// [m]: distance of points of one surface, beside the noise. Source: as the margin of free space.
constexpr double kMaxDistance = 0.1;

/// [-]: standard deviations of the depth. Source: three-sigma rule.
constexpr double kMaxSigmas = 3.0;

/// [-]: patches below which a comparison says nothing. Source: right places had 200 or more.
constexpr std::size_t kMinPatches = 50;

/// Grey values of one surface in two views.
struct GrayPair {
  float a = 0.0F;
  float b = 0.0F;
  bool valid = false;
};

/// Sums over the pixels of a patch.
struct PatchSums {
  float count = 0.0F;
  float a = 0.0F;
  float b = 0.0F;
  float aa = 0.0F;
  float bb = 0.0F;
  float ab = 0.0F;

  void add(const GrayPair& pair) {
    count += 1.0F;
    a += pair.a;
    b += pair.b;
    aa += pair.a * pair.a;
    bb += pair.b * pair.b;
    ab += pair.a * pair.b;
  }

  float covariance() const { return (ab - a * b / count) / count; }
  float variance_a() const { return (aa - a * a / count) / count; }
  float variance_b() const { return (bb - b * b / count) / count; }
};

/// Grey value of a view at a point of its sensor frame [m]; nothing where it measured no static
/// surface there.
std::optional<float> gray_at(const KeyframeView& view, const CameraModel& camera,
                             const Eigen::Vector3d& point, const DepthNoise& noise) {
  if (!(point.z() > 0.0) || !camera.in_lens_range(point)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.project(point);
  const bool is_inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 &&
                         pixel.x() < view.gray.width() - 1 && pixel.y() < view.gray.height() - 1;
  if (!is_inside) return std::nullopt;
  const auto x = static_cast<int>(pixel.x());
  const auto y = static_cast<int>(pixel.y());
  const auto u = static_cast<float>(pixel.x() - x);
  const auto v = static_cast<float>(pixel.y() - y);
  float gray = 0.0F;
  for (int dy = 0; dy <= 1; ++dy) {
    for (int dx = 0; dx <= 1; ++dx) {
      const double z = 0.001 * view.depth_mm(x + dx, y + dy);
      const double margin = kMaxDistance + kMaxSigmas * noise.sigma(z);
      if (view.is_static(x + dx, y + dy) == 0 || std::abs(z - point.z()) > margin)
        return std::nullopt;
      gray += (dx == 0 ? 1.0F - u : u) * (dy == 0 ? 1.0F - v : v) *
              static_cast<float>(view.gray(x + dx, y + dy));
    }
  }
  return gray;
}

/// Grey values of both views, by pixel of `b`.
Image<GrayPair> gray_pairs(const KeyframeView& a, const KeyframeView& b,
                           const Eigen::Isometry3d& T_a_b, const DepthNoise& noise) {
  const CameraModel camera(a.camera);
  const LabeledCloud points = b.cloud();
  Image<GrayPair> pairs(points.width, points.height);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (b.is_static[i] == 0) continue;
    const auto gray = gray_at(a, camera, T_a_b * points.points[i].cast<double>(), noise);
    if (gray) pairs[i] = {*gray, static_cast<float>(b.gray[i]), true};
  }
  return pairs;
}

PatchSums sums_around(const Image<GrayPair>& pairs, int x, int y) {
  PatchSums sums;
  for (int dy = -kPatchRadius; dy <= kPatchRadius; ++dy) {
    for (int dx = -kPatchRadius; dx <= kPatchRadius; ++dx) {
      const GrayPair& pair = pairs(x + dx, y + dy);
      if (pair.valid) sums.add(pair);
    }
  }
  return sums;
}

}  // namespace

TextureComparison& TextureComparison::operator+=(const TextureComparison& other) {
  patches += other.patches;
  different += other.different;
  return *this;
}

double TextureComparison::dissimilarity() const {
  if (patches < kMinPatches) return 0.0;
  return static_cast<double>(different) / static_cast<double>(patches);
}

TextureComparison compare_textures(const KeyframeView& a, const KeyframeView& b,
                                   const Eigen::Isometry3d& T_a_b, const DepthNoise& noise) {
  TextureComparison result;
  if (a.gray.empty() || b.gray.empty()) return result;
  const Image<GrayPair> pairs = gray_pairs(a, b, T_a_b, noise);
  for (int y = kPatchRadius; y + kPatchRadius < pairs.height(); y += kStep) {
    for (int x = kPatchRadius; x + kPatchRadius < pairs.width(); x += kStep) {
      const PatchSums sums = sums_around(pairs, x, y);
      if (sums.count < kMinPixels) continue;
      // The weaker view decides: noise hides what is below it.
      const float contrast =
          std::sqrt(std::max(0.0F, std::min(sums.variance_a(), sums.variance_b())));
      if (contrast < kMinContrast || contrast > kMaxContrast) continue;
      ++result.patches;
      result.different += sums.covariance() < 0.0F ? 1 : 0;
    }
  }
  return result;
}

}  // namespace mms
