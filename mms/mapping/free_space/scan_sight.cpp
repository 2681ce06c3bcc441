#include "mms/mapping/free_space/scan_sight.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mms {
namespace {

/// [px]: side of a face of 90 degrees. Source: half a degree a pixel, 4 cm at 5 m, which is two
/// voxels of the static map.
constexpr int kFaceSize = 180;

/// [-]: pixels of half that width with points over those of the full width, from which on the
/// narrow ones are used. Source: 2 where the points of a ring are closer than the narrow
/// pixels; 1.25 at 0.4 degrees, which leaves holes.
constexpr double kMinRefinement = 1.8;

/// [-]: largest gap between two rings as a share of the face. Source: 3 degrees; LiDARs of 16 rings
/// have 2 degrees.
constexpr int kRingGapsPerFace = 30;

/// [px]: side of the tiles in which the farthest range is kept. Source: a block of 16 cm has 8 px
/// at 4.6 m, so that few tiles decide on it.
constexpr int kTileSize = 8;

using Ranges = Image<float>;  // [m], 0 for none

CubeImage<float> measured_ranges(const LabeledCloud& cloud, int side) {
  CubeImage<float> ranges = make_cube<float>(side);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], side);
    float& nearest = ranges[pixel.face](pixel.x, pixel.y);
    nearest = nearest > 0.0F ? std::min(nearest, range) : range;
  }
  return ranges;
}

/// Minimum of the known ones of 2 x 2 pixels.
CubeImage<float> halved(const CubeImage<float>& ranges) {
  const int side = ranges[0].width() / 2;
  CubeImage<float> half = make_cube<float>(side);
  for (std::size_t face = 0; face < ranges.size(); ++face) {
    for (int y = 0; y < 2 * side; ++y) {
      for (int x = 0; x < 2 * side; ++x) {
        const float range = ranges[face](x, y);
        float& nearest = half[face](x / 2, y / 2);
        if (range > 0.0F) nearest = nearest > 0.0F ? std::min(nearest, range) : range;
      }
    }
  }
  return half;
}

std::ptrdiff_t count_known(const CubeImage<float>& ranges) {
  std::ptrdiff_t count = 0;
  for (const Ranges& face : ranges) {
    count += std::count_if(face.pixels().begin(), face.pixels().end(),
                           [](float range) { return range > 0.0F; });
  }
  return count;
}

/// Ranges in the narrowest directions that the points of the scan fill.
CubeImage<float> resolved_ranges(const LabeledCloud& cloud) {
  CubeImage<float> narrow = measured_ranges(cloud, 2 * kFaceSize);
  CubeImage<float> wide = halved(narrow);
  const auto least = kMinRefinement * static_cast<double>(count_known(wide));
  return static_cast<double>(count_known(narrow)) > least ? std::move(narrow) : std::move(wide);
}

/// Fills the unknown pixels of a row or column with the nearer of the two known ones around them.
void bridge(const Ranges& known, Ranges& bridged, int x, int y, int dx, int dy) {
  const int max_gap = known.width() / kRingGapsPerFace;
  int gap = max_gap + 1;  // since the last known pixel
  for (; known.contains(x, y); x += dx, y += dy) {
    if (known(x, y) == 0.0F) {
      ++gap;
      continue;
    }
    for (int back = gap < max_gap ? gap : 0; back > 0; --back) {
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
  for (int i = 0; i < known.width(); ++i) {
    bridge(known, bridged, 0, i, 1, 0);
    bridge(known, bridged, i, 0, 0, 1);
  }
  return bridged;
}

/// Minimum of 3 x 3 pixels; 0 where one of them is unknown, and on the boundary.
Ranges nearest_about(const Ranges& ranges) {
  Ranges nearest(ranges.width(), ranges.height());
  for (int y = 1; y + 1 < ranges.height(); ++y) {
    for (int x = 1; x + 1 < ranges.width(); ++x) {
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

Ranges farthest_of_tiles(const Ranges& ranges) {
  const int side = (ranges.width() + kTileSize - 1) / kTileSize;
  Ranges tiles(side, side);
  for (int y = 0; y < ranges.height(); ++y) {
    for (int x = 0; x < ranges.width(); ++x) {
      float& tile = tiles(x / kTileSize, y / kTileSize);
      tile = std::max(tile, ranges(x, y));
    }
  }
  return tiles;
}

}  // namespace

ScanSight::ScanSight(const LabeledCloud& cloud, double margin)
    : free_range_(resolved_ranges(cloud)), margin_(static_cast<float>(margin)) {
  for (std::size_t face = 0; face < free_range_.size(); ++face) {
    free_range_[face] = nearest_about(bridge_rings(free_range_[face]));
    farthest_[face] = farthest_of_tiles(free_range_[face]);
    for (const float range : farthest_[face].pixels()) {
      farthest_of_all_ = std::max(farthest_of_all_, range);
    }
  }
}

float ScanSight::free_range(const Eigen::Vector3f& point) const {
  const CubePixel pixel(point, free_range_[0].width());
  return free_range_[pixel.face](pixel.x, pixel.y);
}

bool ScanSight::may_see_into(const Eigen::Vector3f& center, float radius) const {
  const float near = center.norm() - radius;
  if (near + margin_ >= farthest_of_all_) return false;
  const float depth = center.cwiseAbs().maxCoeff() - radius;  // along the axis of the face
  if (depth <= 0.0F) return true;
  // |x/z - cx/cz| <= 2 r / (cz - r) for all points of a ball whose center is on the face.
  const int side = free_range_[0].width();
  const int reach = static_cast<int>(radius / depth * static_cast<float>(side)) + 1;
  const CubePixel pixel(center, side);
  const bool is_on_face =
      pixel.x >= reach && pixel.x + reach < side && pixel.y >= reach && pixel.y + reach < side;
  if (!is_on_face) return true;
  for (int y = (pixel.y - reach) / kTileSize; y <= (pixel.y + reach) / kTileSize; ++y) {
    for (int x = (pixel.x - reach) / kTileSize; x <= (pixel.x + reach) / kTileSize; ++x) {
      if (farthest_[pixel.face](x, y) > near + margin_) return true;
    }
  }
  return false;
}

}  // namespace mms
