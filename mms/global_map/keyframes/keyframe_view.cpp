#include "mms/global_map/keyframes/keyframe_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mms/geometry/camera.hpp"
#include "mms/mapping/free_space/free_space.hpp"

namespace mms {
namespace {

/// [px]: least width of a view. Source: at 80 px a pixel covers 4 cm at 3 m, less than what a
/// contradiction of poses displaces.
constexpr int kViewWidth = 80;

/// [m]: distance before a surface, above noise, that contradicts it. Source: three times the margin
/// of carving, since a view has a sixteenth of the pixels.
constexpr double kMargin = 0.1;

/// [-]: largest depth of a view in mm. Source: the type's range.
constexpr float kMaxDepth = 65535.0F;

/// [-]: differences of depth of neighboring pixels, as a share of the depth, up to which they are
/// compared. Source: a surface at 76 degrees, across two pixels of 80.
constexpr float kMaxSlope = 0.1F;

/// [-]: static points per point that counts for the overlap, at most; people may hide the others.
/// Source: a view that they cover by more than three quarters identifies no place.
constexpr std::size_t kMaxHiddenFactor = 4;

/// [px]: bound on coordinates of pixels. Source: far beyond every view.
constexpr double kMaxPixel = 1e6;

/// `FreeSpace` takes the nearest of nine pixels, so that steep surfaces and boundaries seem to
/// contradict.
bool is_smooth(const Image<std::uint16_t>& depth, int x, int y) {
  const auto center = static_cast<float>(depth(x, y));
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!depth.contains(x + dx, y + dy)) return false;
      const auto z = static_cast<float>(depth(x + dx, y + dy));
      if (z == 0.0F || std::abs(z - center) > kMaxSlope * center) return false;
    }
  }
  return true;
}

/// Whether a person or vehicle of a view hides a point (sensor frame [m]).
bool is_hidden(const KeyframeView& view, const CameraModel& camera, const Eigen::Vector3f& point) {
  const Eigen::Vector3d p = point.cast<double>();
  if (!(p.z() > 0.0) || !camera.in_lens_range(p)) return false;
  const Eigen::Vector2d pixel = camera.project(p);
  if (!(pixel.cwiseAbs().maxCoeff() < kMaxPixel)) return false;
  const auto x = static_cast<int>(std::lround(pixel.x()));
  const auto y = static_cast<int>(std::lround(pixel.y()));
  if (!view.depth_mm.contains(x, y) || view.depth_mm(x, y) == 0) return false;
  return view.is_static(x, y) == 0 && 0.001 * view.depth_mm(x, y) < p.z();
}

/// Mean grey value of the part of the image below each pixel of a view.
/// @param stride  columns and rows of the cloud's grid per pixel
Image<std::uint8_t> gray_below(const Image<Rgb>& color, const LabeledCloud& cloud, int stride,
                               const CameraIntrinsics& camera) {
  Image<std::uint8_t> gray(camera.width, camera.height);
  const double scale_x = static_cast<double>(color.width()) / cloud.width;
  const double scale_y = static_cast<double>(color.height()) / cloud.height;
  const auto end_of = [&](int pixel, double scale) {
    return static_cast<int>(std::lround((pixel + 1) * stride * scale));
  };
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      int sum = 0;
      int count = 0;
      for (int v = end_of(y - 1, scale_y); v < std::min(end_of(y, scale_y), color.height()); ++v) {
        for (int u = end_of(x - 1, scale_x); u < std::min(end_of(x, scale_x), color.width()); ++u) {
          const Rgb& pixel = color(u, v);
          sum += 77 * pixel.r + 150 * pixel.g + 29 * pixel.b;
          ++count;
        }
      }
      if (count > 0) gray(x, y) = static_cast<std::uint8_t>(sum / count / 256);
    }
  }
  return gray;
}

}  // namespace

KeyframeView make_keyframe_view(const Image<Rgb>& color, const LabeledCloud& cloud) {
  KeyframeView view;
  const int stride = std::max(1, cloud.width / kViewWidth);
  view.camera = downscaled(cloud.camera, stride);
  view.depth_mm = Image<std::uint16_t>(view.camera.width, view.camera.height);
  view.is_static = Image<std::uint8_t>(view.camera.width, view.camera.height);
  for (int y = 0; y < view.camera.height; ++y) {
    for (int x = 0; x < view.camera.width; ++x) {
      const int column = x * stride + stride / 2;
      const int row = y * stride + stride / 2;
      const std::size_t i = cloud.index(column, row);
      const float z = 1000.0F * cloud.points[i].z();
      if (cloud.labels[i] == PointLabel::kInvalid || !(z > 0.0F && z < kMaxDepth)) continue;
      view.depth_mm(x, y) = static_cast<std::uint16_t>(z);
      const bool masked = !cloud.dynamic_pixels.empty() && cloud.dynamic_pixels[i] != 0;
      view.is_static(x, y) = cloud.labels[i] == PointLabel::kStatic && !masked ? 1 : 0;
    }
  }
  if (!color.empty()) view.gray = gray_below(color, cloud, stride, view.camera);
  return view;
}

LabeledCloud KeyframeView::cloud() const {
  LabeledCloud cloud;
  cloud.camera = camera;
  cloud.width = depth_mm.width();
  cloud.height = depth_mm.height();
  const std::vector<Eigen::Vector3f> rays = CameraModel(camera).ray_table();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    const bool valid = depth_mm[i] != 0;
    const float z = 0.001F * static_cast<float>(depth_mm[i]);
    cloud.points.push_back(valid ? Eigen::Vector3f(z * rays[i]) : Eigen::Vector3f::Constant(kNan));
    cloud.labels.push_back(!valid              ? PointLabel::kInvalid
                           : is_static[i] != 0 ? PointLabel::kStatic
                                               : PointLabel::kDynamic);
  }
  return cloud;
}

ViewAgreement agreement_of(std::size_t all, std::size_t on_surface, std::size_t in_free_space) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  return {share(on_surface, all), share(in_free_space, on_surface + in_free_space)};
}

ViewAgreement compare_views(const KeyframeView& a, const KeyframeView& b,
                            const Eigen::Isometry3d& T_a_b, const DepthNoise& noise) {
  const FreeSpace space(a.cloud(), kMargin, noise);
  const CameraModel camera(a.camera);
  const Eigen::Isometry3f T = T_a_b.cast<float>();
  const LabeledCloud points = b.cloud();
  std::size_t all = 0;
  std::size_t hidden = 0;
  std::size_t on_surface = 0;
  std::size_t in_free_space = 0;
  for (int y = 0; y < points.height; ++y) {
    for (int x = 0; x < points.width; ++x) {
      if (b.is_static(x, y) == 0 || !is_smooth(b.depth_mm, x, y)) continue;
      const std::size_t i = points.index(x, y);
      const Eigen::Vector3f point = T * points.points[i];
      ++all;
      if (is_hidden(a, camera, point)) {
        ++hidden;
        continue;
      }
      const SpaceState state = space.state_at(point);
      on_surface += state == SpaceState::kSurface;
      in_free_space += state == SpaceState::kFree;
    }
  }
  const std::size_t compared = std::max(all - hidden, all / kMaxHiddenFactor);
  return agreement_of(compared, on_surface, in_free_space);
}

}  // namespace mms
