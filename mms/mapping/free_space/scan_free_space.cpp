#include "mms/mapping/free_space/scan_free_space.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {
namespace {

constexpr int kSide = 90;  // pixels of a face of 90 degrees

}  // namespace

void ScanFreeSpace::Span::extend(float low, float high) {
  if (high <= 0.0F) return;
  nearest = farthest > 0.0F ? std::min(nearest, low) : low;
  farthest = std::max(farthest, high);
}

ScanFreeSpace::ScanFreeSpace(const LabeledCloud& cloud, double margin)
    : faces_(make_cube<Span>(kSide)), margin_(static_cast<float>(margin)) {
  CubeImage<Span> single = make_cube<Span>(kSide);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], kSide);
    single[pixel.face](pixel.x, pixel.y).extend(range, range);
  }
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        Span& span = faces_[face](x, y);
        for (int ny = std::max(0, y - 1); ny <= std::min(y + 1, kSide - 1); ++ny) {
          for (int nx = std::max(0, x - 1); nx <= std::min(x + 1, kSide - 1); ++nx) {
            span.extend(single[face](nx, ny).nearest, single[face](nx, ny).farthest);
          }
        }
      }
    }
  }
}

const ScanFreeSpace::Span& ScanFreeSpace::span_of(const Eigen::Vector3f& point) const {
  const CubePixel pixel(point, kSide);
  return faces_[pixel.face](pixel.x, pixel.y);
}

bool ScanFreeSpace::sees_through(const Eigen::Vector3f& point) const {
  return span_of(point).nearest > point.norm() + margin_;
}

bool ScanFreeSpace::touches(const Eigen::Vector3f& point) const {
  const Span& span = span_of(point);
  const float range = point.norm();
  return span.farthest > 0.0F && range >= span.nearest - margin_ &&
         range <= span.farthest + margin_;
}

bool ScanFreeSpace::has_no_return(const Eigen::Vector3f& point) const {
  return span_of(point).farthest == 0.0F;
}

}  // namespace mms
