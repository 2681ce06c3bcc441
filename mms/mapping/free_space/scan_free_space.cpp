#include "mms/mapping/free_space/scan_free_space.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {
namespace {

/// [px]: side of a face of 90 degrees. Source: one degree a pixel; with its eight neighbours it
/// spans the 2 degrees between two rings of 16.
constexpr int kFaceSize = 90;

}  // namespace

void ScanFreeSpace::Span::extend(float low, float high) {
  if (high <= 0.0F) return;
  nearest = farthest > 0.0F ? std::min(nearest, low) : low;
  farthest = std::max(farthest, high);
}

ScanFreeSpace::ScanFreeSpace(const LabeledCloud& cloud, double margin)
    : faces_(make_cube<Span>(kFaceSize)), margin_(static_cast<float>(margin)) {
  CubeImage<Span> single = make_cube<Span>(kFaceSize);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], kFaceSize);
    single[pixel.face](pixel.x, pixel.y).extend(range, range);
  }
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    for (int y = 0; y < kFaceSize; ++y) {
      for (int x = 0; x < kFaceSize; ++x) {
        Span& span = faces_[face](x, y);
        for (int ny = std::max(0, y - 1); ny <= std::min(y + 1, kFaceSize - 1); ++ny) {
          for (int nx = std::max(0, x - 1); nx <= std::min(x + 1, kFaceSize - 1); ++nx) {
            span.extend(single[face](nx, ny).nearest, single[face](nx, ny).farthest);
          }
        }
      }
    }
  }
}

const ScanFreeSpace::Span& ScanFreeSpace::span_of(const Eigen::Vector3f& point) const {
  const CubePixel pixel(point, kFaceSize);
  return faces_[pixel.face](pixel.x, pixel.y);
}

SpaceState ScanFreeSpace::state_at(const Eigen::Vector3f& point) const {
  const Span& span = span_of(point);
  if (span.farthest == 0.0F) return SpaceState::kNoReturn;
  const float range = point.norm();
  if (span.nearest > range + margin_) return SpaceState::kFree;
  return range <= span.farthest + margin_ ? SpaceState::kSurface : SpaceState::kUnknown;
}

}  // namespace mms
