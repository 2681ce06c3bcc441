#include "mms/report/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr Rgb kBackground{248, 248, 245};

/// A point in view coordinates: right, up and towards the viewer [m].
struct SeenPoint {
  float right;
  float up;
  float to_viewer;
  Rgb color;
};

/// Interval of the central 99 % of the coordinates.
struct Extent {
  float min = 0.0F;
  float max = 0.0F;

  float length() const { return max - min; }
  float centre() const { return 0.5F * (min + max); }
};

Extent extent(std::vector<float> values) {
  if (values.empty()) return {};
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 200);
  std::nth_element(values.begin(), values.begin() + cut, values.end());
  const float low = values[static_cast<std::size_t>(cut)];
  std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
  return {low, *(values.end() - 1 - cut)};
}

/// Dark blue over green to yellow for `share` in [0, 1].
Rgb height_color(float share) {
  constexpr std::array<std::array<float, 3>, 4> kStops = {{{59.0F, 76.0F, 140.0F},
                                                           {33.0F, 145.0F, 140.0F},
                                                           {94.0F, 190.0F, 90.0F},
                                                           {235.0F, 200.0F, 40.0F}}};
  const float place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const float t = place - static_cast<float>(below);
  const auto mix = [&](std::size_t c) {
    return static_cast<std::uint8_t>((1.0F - t) * kStops[below][c] + t * kStops[below + 1][c]);
  };
  return {mix(0), mix(1), mix(2)};
}

void color_by_height(std::vector<SeenPoint>& seen, const std::vector<float>& heights) {
  const Extent range = extent(heights);
  const float length = std::max(range.length(), 1e-6F);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i].color = height_color((heights[i] - range.min) / length);
  }
}

std::vector<SeenPoint> look(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                            const MapPictureOptions& options) {
  const ViewAxes axes = view_axes(options.viewpoint, options.up);
  std::vector<SeenPoint> seen;
  std::vector<float> heights;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = points[i].cast<double>();
    const double above = height(point, options.up);
    const double depth = axes.to_viewer.dot(point);
    const bool behind = options.viewpoint == Viewpoint::kFront && depth > 0.0;
    if (!point.allFinite() || above > options.max_height || behind) continue;
    seen.push_back({static_cast<float>(axes.right.dot(point)),
                    static_cast<float>(axes.up.dot(point)), static_cast<float>(depth),
                    colors.empty() ? Rgb{} : colors[i]});
    heights.push_back(static_cast<float>(above));
  }
  if (colors.empty()) color_by_height(seen, heights);
  return seen;
}

/// Draws squares into an image with a z-buffer.
class Painter {
 public:
  Painter(const std::vector<SeenPoint>& seen, const MapPictureOptions& options)
      : picture_(options.width, options.height, kBackground),
        depth_(options.width, options.height, -std::numeric_limits<float>::infinity()) {
    std::vector<float> rights;
    std::vector<float> ups;
    for (const SeenPoint& point : seen) {
      rights.push_back(point.right);
      ups.push_back(point.up);
    }
    constexpr float kMargin = 1.06F;
    constexpr float kMinLength = 0.01F;
    right_ = extent(rights);
    up_ = extent(ups);
    const float width = std::max(kMargin * right_.length(), kMinLength);
    const float tall = std::max(kMargin * up_.length(), kMinLength);
    scale_ = std::min(static_cast<float>(options.width) / width,
                      static_cast<float>(options.height) / tall);
    constexpr double kMaxDot = 15.0;
    const double dot = std::clamp(std::ceil(options.point_size * scale_), 1.0, kMaxDot);
    dot_ = static_cast<int>(dot);
  }

  void paint(const SeenPoint& point) {
    const float x =
        0.5F * static_cast<float>(picture_.width()) + scale_ * (point.right - right_.centre());
    const float y =
        0.5F * static_cast<float>(picture_.height()) - scale_ * (point.up - up_.centre());
    const bool outside = !(x >= 0.0F && y >= 0.0F && x < static_cast<float>(picture_.width()) &&
                           y < static_cast<float>(picture_.height()));
    if (outside) return;
    const int left = static_cast<int>(x) - dot_ / 2;
    const int top = static_cast<int>(y) - dot_ / 2;
    for (int row = top; row < top + dot_; ++row) {
      for (int column = left; column < left + dot_; ++column) paint_pixel(column, row, point);
    }
  }

  const Image<Rgb>& picture() const { return picture_; }

 private:
  void paint_pixel(int x, int y, const SeenPoint& point) {
    if (!picture_.contains(x, y) || depth_(x, y) >= point.to_viewer) return;
    depth_(x, y) = point.to_viewer;
    picture_(x, y) = point.color;
  }

  Image<Rgb> picture_;
  Image<float> depth_;
  Extent right_;
  Extent up_;
  float scale_ = 1.0F;  ///< [px/m]
  int dot_ = 1;         ///< edge of a point's square [px]
};

void check(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
           const MapPictureOptions& options) {
  const int smaller = std::min(options.width, options.height);
  if (smaller < 1 || std::max(options.width, options.height) > kMaxImageSide) {
    throw DataError("map picture", std::to_string(options.width) + " x " +
                                       std::to_string(options.height) + " pixels, allowed: 1 to " +
                                       std::to_string(kMaxImageSide));
  }
  if (!colors.empty() && colors.size() != points.size()) {
    throw DataError("map picture", std::to_string(points.size()) + " points and " +
                                       std::to_string(colors.size()) + " colors");
  }
}

}  // namespace

Image<Rgb> draw_map(std::span<const Eigen::Vector3f> points, std::span<const Rgb> colors,
                    const MapPictureOptions& options) {
  check(points, colors, options);
  const std::vector<SeenPoint> seen = look(points, colors, options);
  Painter painter(seen, options);
  for (const SeenPoint& point : seen) painter.paint(point);
  return painter.picture();
}

}  // namespace mms
