#include "mms/mapping/static_map/surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mms {
namespace {

/// [-]: depth noise that a second difference may have. Source: three standard deviations of it,
/// 3 sqrt(1 + 2^2 + 1) of those of a depth.
constexpr float kSecondDifferenceSigmas = 7.3F;

/// [px]: step of the central differences of a normal. Source: noise then turns it by about ten
/// degrees at 2 m.
constexpr int kNormalStep = 3;

/// [m^2]: least length of a normal before it is normalised. Source: far below the square of any
/// distance between pixels.
constexpr float kMinNormalLength = 1e-12F;

/// The organised cloud as an image of inverse depth, which is linear on any plane: its second
/// difference detects jumps, but not a floor at a grazing angle.
class Grid {
 public:
  Grid(const LabeledCloud& cloud, const SurfaceConfig& config)
      : cloud_(cloud), config_(config), inverse_(cloud.width, cloud.height) {
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      const float z = cloud.points[i].z();
      inverse_[i] = z > 0.0F ? 1.0F / z : 0.0F;
    }
  }

  /// Largest difference of inverse depth at depth `z` that noise and `max_jump` explain.
  float tolerance(float z) const {
    const float noise = kSecondDifferenceSigmas * config_.noise.depth.sigma(z);
    return (static_cast<float>(config_.max_jump) + noise) / (z * z);
  }

  /// Whether the pixel lies inside a surface: it has neighbours with depths on every side, and
  /// there is no jump at it or beside it. At the boundaries of objects depth and colour are off by
  /// a pixel. Far away single dropouts are frequent, but rarely cover a whole side.
  bool inside_surface(int x, int y, float tolerance) const {
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (is_side_missing(x, y, dx, dy)) return false;
    }
    for (int d = -1; d <= 1; ++d) {
      if (inverse(x + d, y) > 0.0F && !smooth(x + d, y, 1, 0, tolerance)) return false;
      if (inverse(x, y + d) > 0.0F && !smooth(x, y + d, 0, 1, tolerance)) return false;
    }
    return true;
  }

  /// Normal from central differences; zero where a neighbour is missing or across a jump.
  Eigen::Vector3f normal(int x, int y, float tolerance) const {
    const bool whole = inverse(x - kNormalStep, y) > 0.0F && inverse(x + kNormalStep, y) > 0.0F &&
                       inverse(x, y - kNormalStep) > 0.0F && inverse(x, y + kNormalStep) > 0.0F &&
                       smooth(x, y, kNormalStep, 0, tolerance) &&
                       smooth(x, y, 0, kNormalStep, tolerance);
    if (!whole) return Eigen::Vector3f::Zero();
    const Eigen::Vector3f along_x = point(x + kNormalStep, y) - point(x - kNormalStep, y);
    const Eigen::Vector3f along_y = point(x, y + kNormalStep) - point(x, y - kNormalStep);
    const Eigen::Vector3f normal = along_y.cross(along_x);  // towards the camera
    const float length = normal.norm();
    return length > kMinNormalLength ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::Zero();
  }

 private:
  const Eigen::Vector3f& point(int x, int y) const { return cloud_.points[cloud_.index(x, y)]; }

  bool is_missing(int x, int y) const { return inverse_.contains(x, y) && inverse_(x, y) <= 0.0F; }

  /// Whether all three neighbours on the side of (dx, dy) have no depth.
  bool is_side_missing(int x, int y, int dx, int dy) const {
    return is_missing(x + dx, y + dy) && is_missing(x + dx - dy, y + dy - dx) &&
           is_missing(x + dx + dy, y + dy + dx);
  }

  float inverse(int x, int y) const { return inverse_.contains(x, y) ? inverse_(x, y) : 0.0F; }

  /// No jump at (x, y) along one axis. Beside a hole only the first difference is available.
  bool smooth(int x, int y, int dx, int dy, float tolerance) const {
    const float here = inverse_(x, y);
    const float before = inverse(x - dx, y - dy);
    const float after = inverse(x + dx, y + dy);
    if (before > 0.0F && after > 0.0F) return std::abs(2.0F * here - before - after) <= tolerance;
    const float single = std::max(before, after);
    return single == 0.0F || std::abs(here - single) <= tolerance;
  }

  const LabeledCloud& cloud_;
  const SurfaceConfig& config_;
  Image<float> inverse_;  // [1/m], 0 for no return
};

/// Dilates a row or column by `radius` pixels.
void dilate(const std::uint8_t* from, std::size_t step, int count, int radius, std::uint8_t* to) {
  for (int i = 0, next = 0; i < count; ++i) {
    if (from[static_cast<std::size_t>(i) * step] == 0) continue;
    next = std::max(next, i - radius);
    for (; next <= std::min(i + radius, count - 1); ++next) {
      to[static_cast<std::size_t>(next) * step] = 1;
    }
  }
}

/// Non-zero within `radius` pixels of a dynamic pixel; empty where nothing is dynamic.
Image<std::uint8_t> near_dynamic(const Image<std::uint8_t>& dynamic, int radius) {
  const auto& pixels = dynamic.pixels();
  const bool any = std::any_of(pixels.begin(), pixels.end(), [](auto p) { return p != 0; });
  if (!any || radius == 0) return any ? dynamic : Image<std::uint8_t>();
  Image<std::uint8_t> rows(dynamic.width(), dynamic.height());
  for (int y = 0; y < dynamic.height(); ++y) {
    dilate(dynamic.row(y), 1, dynamic.width(), radius, rows.row(y));
  }
  Image<std::uint8_t> dilated(dynamic.width(), dynamic.height());
  const auto width = static_cast<std::size_t>(dynamic.width());
  for (int x = 0; x < dynamic.width(); ++x) {
    dilate(rows.row(0) + x, width, dynamic.height(), radius, dilated.row(0) + x);
  }
  return dilated;
}

/// The intensity of a LiDAR is a grey where no camera sees the point: its color is black there.
Rgb color_of(const LabeledCloud& cloud, std::size_t i) {
  const bool is_seen = !cloud.colors.empty() && (cloud.organised() || cloud.colors[i] != Rgb{});
  if (is_seen) return cloud.colors[i];
  return cloud.intensity.empty() ? kNoColor : grey_of(cloud.intensity[i]);
}

std::vector<SurfacePoint> organised_points(const LabeledCloud& cloud, const SurfaceConfig& config,
                                           int step) {
  const Grid grid(cloud, config);
  const Image<std::uint8_t> boundary = near_dynamic(
      cloud.dynamic_pixels, static_cast<int>(std::lround(config.boundary * cloud.width)));
  std::vector<SurfacePoint> result;
  result.reserve(cloud.points.size() / static_cast<std::size_t>(step * step));
  for (int y = 0; y < cloud.height; y += step) {
    for (int x = 0; x < cloud.width; x += step) {
      const std::size_t i = cloud.index(x, y);
      const float z = cloud.points[i].z();
      if (cloud.labels[i] != PointLabel::kStatic || !(z > 0.0F)) continue;
      if (z > static_cast<float>(config.max_depth)) continue;
      if (!boundary.empty() && boundary[i] != 0) continue;
      const float tolerance = grid.tolerance(z);
      if (!grid.inside_surface(x, y, tolerance)) continue;
      const float weight = noise_weight(config.noise.depth.sigma(z), config.noise.depth);
      result.push_back({cloud.points[i], grid.normal(x, y, tolerance), weight, color_of(cloud, i)});
    }
  }
  return result;
}

std::vector<SurfacePoint> scan_points(const LabeledCloud& cloud, const SurfaceConfig& config) {
  const auto limit = static_cast<float>(config.max_range);
  std::vector<SurfacePoint> result;
  result.reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != PointLabel::kStatic) continue;
    if (!(cloud.points[i].norm() <= limit)) continue;
    result.push_back({cloud.points[i], Eigen::Vector3f::Zero(), 1.0F, color_of(cloud, i)});
  }
  return result;
}

}  // namespace

std::vector<SurfacePoint> surface_points(const LabeledCloud& cloud, const SurfaceConfig& config,
                                         int step) {
  return cloud.organised() ? organised_points(cloud, config, step) : scan_points(cloud, config);
}

}  // namespace mms
