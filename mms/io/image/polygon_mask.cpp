#include "mms/io/image/polygon_mask.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mms/core/error.hpp"
#include "mms/io/image/image_container.hpp"

namespace mms {
namespace {

// Outlines are traced on a grid finer than the pixels by this factor.
constexpr double kScale = 5.0;
constexpr double kMaxCoordinate = 1e6;
constexpr std::size_t kMinNumbers = 6;

struct GridPoint {
  int x = 0;
  int y = 0;
};

void check(const Polygon& polygon) {
  if (polygon.size() < kMinNumbers || polygon.size() % 2 != 0) {
    throw DataError("polygon", "has " + std::to_string(polygon.size()) + " numbers",
                    "expected x and y of at least three corners");
  }
  for (const double value : polygon) {
    if (!(std::abs(value) <= kMaxCoordinate)) {
      throw DataError("polygon", "has the coordinate " + std::to_string(value) +
                                     ", allowed: finite, within 1e6 px");
    }
  }
}

/// Points of an outline on the finer grid: 128 MiB.
constexpr std::size_t kMaxOutline = std::size_t{1} << 24U;

int round_half_up(double value) {
  return static_cast<int>(value + 0.5);
}

void walk_edge(GridPoint from, GridPoint to, std::vector<GridPoint>& outline) {
  const int dx = std::abs(to.x - from.x);
  const int dy = std::abs(to.y - from.y);
  const bool flat = dx >= dy;
  const bool flip = flat ? from.x > to.x : from.y > to.y;
  if (flip) std::swap(from, to);
  const int steps = flat ? dx : dy;
  const double slope =
      steps == 0 ? 0.0 : static_cast<double>(flat ? to.y - from.y : to.x - from.x) / steps;
  for (int i = 0; i <= steps; ++i) {
    const int t = flip ? steps - i : i;
    if (flat) {
      outline.push_back({from.x + t, round_half_up(from.y + slope * t)});
    } else {
      outline.push_back({round_half_up(from.x + slope * t), from.y + t});
    }
  }
}

std::vector<GridPoint> outline_of(const Polygon& polygon) {
  std::vector<GridPoint> corners;
  for (std::size_t i = 0; i < polygon.size(); i += 2) {
    corners.push_back({round_half_up(kScale * polygon[i]), round_half_up(kScale * polygon[i + 1])});
  }
  corners.push_back(corners.front());
  std::size_t length = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    length += static_cast<std::size_t>(std::max(std::abs(corners[i + 1].x - corners[i].x),
                                                std::abs(corners[i + 1].y - corners[i].y))) +
              1;
  }
  if (length > kMaxOutline) {
    throw DataError("polygon", "has an outline of " + std::to_string(length) +
                                   " points, allowed: up to " + std::to_string(kMaxOutline));
  }
  std::vector<GridPoint> outline;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    walk_edge(corners[i], corners[i + 1], outline);
  }
  return outline;
}

/// Positions (column-major) at which the polygon begins or ends; ascending.
std::vector<std::uint32_t> crossings(const std::vector<GridPoint>& outline, int width, int height) {
  std::vector<std::uint32_t> positions;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const GridPoint& a = outline[i - 1];
    const GridPoint& b = outline[i];
    if (a.x == b.x) continue;
    const double x = ((b.x < a.x ? b.x : b.x - 1) + 0.5) / kScale - 0.5;
    if (std::floor(x) != x || x < 0.0 || x > width - 1) continue;
    const double y = (std::min(a.y, b.y) + 0.5) / kScale - 0.5;
    const double row = std::ceil(std::clamp(y, 0.0, static_cast<double>(height)));
    positions.push_back(static_cast<std::uint32_t>(x) * static_cast<std::uint32_t>(height) +
                        static_cast<std::uint32_t>(row));
  }
  std::sort(positions.begin(), positions.end());
  return positions;
}

/// Runs between the positions at which a polygon begins or ends.
Rle runs_between(std::vector<std::uint32_t> positions, int width, int height) {
  positions.push_back(static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(height));
  Rle rle{width, height, {positions.front()}};
  for (std::size_t i = 1; i < positions.size(); ++i) {
    if (positions[i] > positions[i - 1]) {
      rle.counts.push_back(positions[i] - positions[i - 1]);
    } else if (++i < positions.size()) {  // ends where it begins: the previous run continues
      rle.counts.back() += positions[i] - positions[i - 1];
    }
  }
  return rle;
}

void fill(const Polygon& polygon, Image<std::uint8_t>& mask) {
  const auto positions = crossings(outline_of(polygon), mask.width(), mask.height());
  const auto height = static_cast<std::uint32_t>(mask.height());
  for (std::size_t i = 0; i < positions.size(); i += 2) {
    const std::uint32_t end =
        i + 1 < positions.size() ? positions[i + 1] : static_cast<std::uint32_t>(mask.size());
    for (std::uint32_t k = positions[i]; k < end; ++k) {
      mask(static_cast<int>(k / height), static_cast<int>(k % height)) = 1;
    }
  }
}

}  // namespace

Rle rasterise(std::span<const Polygon> polygons, int width, int height) {
  for (const Polygon& polygon : polygons) check(polygon);
  if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > pixel_limit()) {
    throw DataError("mask",
                    "has " + std::to_string(width) + " x " + std::to_string(height) +
                        " pixels, allowed: up to " + std::to_string(pixel_limit()) + " pixels",
                    "the environment variable MMS_MAX_IMAGE_PIXELS sets the limit");
  }
  if (polygons.size() == 1) {  // the frequent case, and much faster
    return runs_between(crossings(outline_of(polygons[0]), width, height), width, height);
  }
  Image<std::uint8_t> mask(width, height);
  for (const Polygon& polygon : polygons) fill(polygon, mask);
  return encode_rle(mask);
}

}  // namespace mms
