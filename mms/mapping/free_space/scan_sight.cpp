#include "mms/mapping/free_space/scan_sight.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {
namespace {

constexpr int kSide = 180;  // pixels of a face of 90 degrees
constexpr int kGap = 6;     // pixels from one ring to the next, at most

using Ranges = Image<float>;  // [m], 0 for none

CubeImage<float> measured_ranges(const LabeledCloud& cloud) {
  CubeImage<float> ranges = make_cube<float>(kSide);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], kSide);
    float& nearest = ranges[pixel.face](pixel.x, pixel.y);
    nearest = nearest > 0.0F ? std::min(nearest, range) : range;
  }
  return ranges;
}

/// Gives the unknown pixels of a line, from one end to the other, the nearer of the two known ones
/// that they lie between.
void bridge(const Ranges& known, Ranges& bridged, int x, int y, int dx, int dy) {
  int gap = kGap + 1;  // since the last known pixel
  for (; known.contains(x, y); x += dx, y += dy) {
    if (known(x, y) == 0.0F) {
      ++gap;
      continue;
    }
    for (int back = gap < kGap ? gap : 0; back > 0; --back) {
      const float before = known(x - (gap + 1) * dx, y - (gap + 1) * dy);
      const float nearer = std::min(before, known(x, y));
      float& between = bridged(x - back * dx, y - back * dy);
      between = between > 0.0F ? std::min(between, nearer) : nearer;
    }
    gap = 0;
  }
}

Ranges bridge_rings(const Ranges& known) {
  Ranges bridged = known;
  for (int i = 0; i < kSide; ++i) {
    bridge(known, bridged, 0, i, 1, 0);
    bridge(known, bridged, i, 0, 0, 1);
  }
  return bridged;
}

/// Minimum of 3 x 3 pixels; 0 where one of them is unknown, and on the boundary.
Ranges nearest_about(const Ranges& ranges) {
  Ranges nearest(kSide, kSide);
  for (int y = 1; y + 1 < kSide; ++y) {
    for (int x = 1; x + 1 < kSide; ++x) {
      float least = ranges(x, y);
      for (int row = y - 1; row <= y + 1; ++row) {
        const float* r = ranges.row(row) + x;
        least = std::min({least, r[-1], r[0], r[1]});
      }
      nearest(x, y) = least;
    }
  }
  return nearest;
}

}  // namespace

ScanSight::ScanSight(const LabeledCloud& cloud, double margin)
    : free_range_(measured_ranges(cloud)), margin_(static_cast<float>(margin)) {
  for (Ranges& face : free_range_) face = nearest_about(bridge_rings(face));
}

float ScanSight::free_range(const Eigen::Vector3f& point) const {
  const CubePixel pixel(point, kSide);
  return free_range_[pixel.face](pixel.x, pixel.y);
}

}  // namespace mms
