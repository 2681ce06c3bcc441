#include "mms/mapping/scan_free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mms {
namespace {

constexpr int kSide = 90;  // pixels of a face of 90 degrees

struct Pixel {
  std::size_t face;
  int x;
  int y;
};

/// Where the direction of a point meets the cube.
Pixel pixel_of(const Eigen::Vector3f& point) {
  Eigen::Index axis = 0;
  const float along = point.cwiseAbs().maxCoeff(&axis);
  const auto place = [&](float across) {
    const auto pixel = static_cast<int>((across / along + 1.0F) * (0.5F * kSide));
    return std::clamp(pixel, 0, kSide - 1);
  };
  const auto face = static_cast<std::size_t>(2 * axis + (point(axis) < 0.0F ? 1 : 0));
  return {face, place(point((axis + 1) % 3)), place(point((axis + 2) % 3))};
}

}  // namespace

void ScanFreeSpace::Span::extend(float low, float high) {
  if (high <= 0.0F) return;
  nearest = farthest > 0.0F ? std::min(nearest, low) : low;
  farthest = std::max(farthest, high);
}

ScanFreeSpace::ScanFreeSpace(const LabeledCloud& cloud, double margin)
    : margin_(static_cast<float>(margin)) {
  std::array<Image<Span>, 6> single;
  single.fill(Image<Span>(kSide, kSide));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float range = cloud.points[i].norm();
    if (cloud.labels[i] == PointLabel::kInvalid || !(range > 0.0F)) continue;
    const Pixel pixel = pixel_of(cloud.points[i]);
    single[pixel.face](pixel.x, pixel.y).extend(range, range);
  }
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    faces_[face] = Image<Span>(kSide, kSide);
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
  const Pixel pixel = pixel_of(point);
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

bool ScanFreeSpace::is_blank(const Eigen::Vector3f& point) const {
  return span_of(point).farthest == 0.0F;
}

}  // namespace mms
