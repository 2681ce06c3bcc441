#include "mms/mapping/free_space/scan_sight.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {
namespace {

/// [px]: side of a face of 90 degrees. Source: half a degree a pixel, 4 cm at 5 m, which is two
/// voxels of the static map.
constexpr int kFaceSize = 180;

/// [px]: largest gap between two rings. Source: 3 degrees; LiDARs of 16 rings have 2 degrees.
constexpr int kMaxRingGap = 6;

using Ranges = Image<float>;  // [m], 0 for none

CubeImage<float> measured_ranges(const LabeledCloud& cloud) {
  CubeImage<float> ranges = make_cube<float>(kFaceSize);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], kFaceSize);
    float& nearest = ranges[pixel.face](pixel.x, pixel.y);
    nearest = nearest > 0.0F ? std::min(nearest, range) : range;
  }
  return ranges;
}

/// Fills the unknown pixels of a row or column with the nearer of the two known ones around them.
void bridge(const Ranges& known, Ranges& bridged, int x, int y, int dx, int dy) {
  int gap = kMaxRingGap + 1;  // since the last known pixel
  for (; known.contains(x, y); x += dx, y += dy) {
    if (known(x, y) == 0.0F) {
      ++gap;
      continue;
    }
    for (int back = gap < kMaxRingGap ? gap : 0; back > 0; --back) {
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
  for (int i = 0; i < kFaceSize; ++i) {
    bridge(known, bridged, 0, i, 1, 0);
    bridge(known, bridged, i, 0, 0, 1);
  }
  return bridged;
}

/// Minimum of 3 x 3 pixels; 0 where one of them is unknown, and on the boundary.
Ranges nearest_about(const Ranges& ranges) {
  Ranges nearest(kFaceSize, kFaceSize);
  for (int y = 1; y + 1 < kFaceSize; ++y) {
    for (int x = 1; x + 1 < kFaceSize; ++x) {
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
  const CubePixel pixel(point, kFaceSize);
  return free_range_[pixel.face](pixel.x, pixel.y);
}

}  // namespace mms
