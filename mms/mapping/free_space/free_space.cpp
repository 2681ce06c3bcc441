#include "mms/mapping/free_space/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

/// [px]: side of the tiles in which the farthest depth is kept. Source: a block of 16 cm has 23 px
/// at 4 m and a focal length of 580 px, so that a few tiles decide on it.
constexpr int kTileSize = 8;

/// [m]: depth of points out of view. Source: no depth is negative.
constexpr float kOutOfView = -1.0F;

/// Depth of every pixel, 0 for none.
Image<float> depth_of(const LabeledCloud& cloud, FreeSpace::Returns returns) {
  Image<float> depth(cloud.width, cloud.height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float z = cloud.points[i].z();
    const bool is_used =
        cloud.labels[i] == PointLabel::kStatic ||
        (cloud.labels[i] == PointLabel::kDynamic && returns == FreeSpace::Returns::kAll);
    depth[i] = is_used && std::isfinite(z) && z > 0.0F ? z : 0.0F;
  }
  return depth;
}

/// Minimum of 3 x 3 pixels; 0 on the image's boundary.
Image<float> nearest_of_neighbours(const Image<float>& depth) {
  const int width = depth.width();
  const int height = depth.height();
  Image<float> columns(width, height);
  for (int y = 1; y + 1 < height; ++y) {
    const float* above = depth.row(y - 1);
    const float* here = depth.row(y);
    const float* below = depth.row(y + 1);
    float* out = columns.row(y);
    for (int x = 0; x < width; ++x) out[x] = std::min(std::min(above[x], here[x]), below[x]);
  }
  Image<float> nearest(width, height);
  for (int y = 1; y + 1 < height; ++y) {
    const float* in = columns.row(y);
    float* out = nearest.row(y);
    for (int x = 1; x + 1 < width; ++x) out[x] = std::min(std::min(in[x - 1], in[x]), in[x + 1]);
  }
  return nearest;
}

Image<float> farthest_of_tiles(const Image<float>& depth) {
  Image<float> tiles((depth.width() + kTileSize - 1) / kTileSize,
                     (depth.height() + kTileSize - 1) / kTileSize);
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      float& tile = tiles(x / kTileSize, y / kTileSize);
      tile = std::max(tile, depth(x, y));
    }
  }
  return tiles;
}

}  // namespace

FreeSpace::FreeSpace(const LabeledCloud& cloud, double margin, const DepthNoise& noise,
                     Returns returns)
    : camera_(cloud.camera),
      distorted_(cloud.camera.distortion != decltype(cloud.camera.distortion){}),
      focal_(Eigen::Array2d(cloud.camera.fx, cloud.camera.fy).cast<float>()),
      center_(Eigen::Array2d(cloud.camera.cx, cloud.camera.cy).cast<float>()),
      margin_(static_cast<float>(margin)),
      noise_(noise),
      nearest_(nearest_of_neighbours(depth_of(cloud, returns))),
      farthest_(farthest_of_tiles(nearest_)) {}

Eigen::Vector2f FreeSpace::pixel_of(const Eigen::Vector3f& point) const {
  // Called for every voxel in view.
  if (!distorted_) return focal_ * point.head<2>().array() / point.z() + center_;
  const Eigen::Vector3d p = point.cast<double>();
  if (!camera_.in_lens_range(p)) return Eigen::Vector2f::Constant(-1.0F);
  return camera_.project(p).cast<float>();
}

/// Depth of the surface measured in a point's direction, 0 without one, kOutOfView beyond the
/// image.
float FreeSpace::depth_at(const Eigen::Vector3f& point) const {
  if (!(point.z() > 0.0F)) return kOutOfView;
  const Eigen::Vector2f pixel = pixel_of(point);
  // The outermost pixels, which have too few neighbours, never carve.
  if (!(pixel.x() >= 0.5F && pixel.x() < static_cast<float>(nearest_.width()) - 1.0F))
    return kOutOfView;
  if (!(pixel.y() >= 0.5F && pixel.y() < static_cast<float>(nearest_.height()) - 1.0F))
    return kOutOfView;
  return nearest_(static_cast<int>(pixel.x() + 0.5F), static_cast<int>(pixel.y() + 0.5F));
}

bool FreeSpace::sees_through(const Eigen::Vector3f& point) const {
  const float depth = depth_at(point);
  return depth > 0.0F && depth > needed_depth(point.z());
}

SpaceState FreeSpace::state_at(const Eigen::Vector3f& point) const {
  const float depth = depth_at(point);
  if (depth == 0.0F) return SpaceState::kNoReturn;
  if (depth == kOutOfView) return SpaceState::kUnknown;
  const float needed = needed_depth(point.z());
  if (depth > needed) return SpaceState::kFree;
  const bool touches = std::abs(depth - point.z()) <= needed - point.z();
  return touches ? SpaceState::kSurface : SpaceState::kUnknown;
}

bool FreeSpace::may_see_into(const Eigen::Vector3f& center, float radius) const {
  const float near = center.z() - radius;
  if (center.z() + radius <= 0.0F) return false;
  if (near <= 0.0F) return true;
  // |x/z - cx/cz| <= r (1 + |cx/cz|) / (cz - r) for all points of the ball.
  const CameraIntrinsics& k = camera_.intrinsics();
  const Eigen::Vector2d pixel = camera_.project(center.cast<double>());
  const double rx = k.fx * radius * (1.0 + std::abs(center.x() / center.z())) / near;
  const double ry = k.fy * radius * (1.0 + std::abs(center.y() / center.z())) / near;
  if (pixel.x() + rx < 0.0 || pixel.x() - rx >= k.width) return false;
  if (pixel.y() + ry < 0.0 || pixel.y() - ry >= k.height) return false;
  const auto tile = [](double value, int count) {
    return std::clamp(static_cast<int>(std::clamp(value, 0.0, 1e6)) / kTileSize, 0, count - 1);
  };
  const int x_end = tile(pixel.x() + rx, farthest_.width());
  const int y_end = tile(pixel.y() + ry, farthest_.height());
  for (int y = tile(pixel.y() - ry, farthest_.height()); y <= y_end; ++y) {
    for (int x = tile(pixel.x() - rx, farthest_.width()); x <= x_end; ++x) {
      if (farthest_(x, y) > needed_depth(near)) return true;
    }
  }
  return false;
}

}  // namespace mms
