#include "mms/mapping/free_space/scan_free_space.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mms {
namespace {

/// [px]: side of a face of 90 degrees. Source: one degree a pixel; with its eight neighbours it
/// spans the 2 degrees between two rings of 16.
constexpr int kFaceSize = 90;

/// [-]: pixels of half that width with points over those of the full width, from which on the
/// narrow ones are used. Source: 3.7 to 3.9 with 64 rings, whose points fill them; 2 with 16 rings,
/// between which there are pixels without a point.
constexpr double kMinFilled = 3.0;

template <class Span>
double count_known(const CubeImage<Span>& cube) {
  std::ptrdiff_t count = 0;
  for (const Image<Span>& face : cube) {
    count += std::count_if(face.pixels().begin(), face.pixels().end(),
                           [](const Span& span) { return span.farthest > 0.0F; });
  }
  return static_cast<double>(count);
}

}  // namespace

void ScanFreeSpace::Span::extend(float low, float high) {
  if (high <= 0.0F) return;
  nearest = farthest > 0.0F ? std::min(nearest, low) : low;
  farthest = std::max(farthest, high);
}

CubeImage<ScanFreeSpace::Span> ScanFreeSpace::spans_of(const LabeledCloud& cloud, int side) {
  CubeImage<Span> spans = make_cube<Span>(side);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !has_direction(range)) continue;
    const CubePixel pixel(cloud.points[i], side);
    spans[pixel.face](pixel.x, pixel.y).extend(range, range);
  }
  return spans;
}

ScanFreeSpace::ScanFreeSpace(const LabeledCloud& cloud, double margin)
    : margin_(static_cast<float>(margin)) {
  CubeImage<Span> single = spans_of(cloud, kFaceSize);
  CubeImage<Span> narrow = spans_of(cloud, 2 * kFaceSize);
  if (count_known(narrow) > kMinFilled * count_known(single)) single = std::move(narrow);
  const int side = single[0].width();
  faces_ = make_cube<Span>(side);
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        Span& span = faces_[face](x, y);
        for (int ny = std::max(0, y - 1); ny <= std::min(y + 1, side - 1); ++ny) {
          for (int nx = std::max(0, x - 1); nx <= std::min(x + 1, side - 1); ++nx) {
            span.extend(single[face](nx, ny).nearest, single[face](nx, ny).farthest);
          }
        }
      }
    }
  }
}

const ScanFreeSpace::Span& ScanFreeSpace::span_of(const Eigen::Vector3f& point) const {
  const CubePixel pixel(point, faces_[0].width());
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
