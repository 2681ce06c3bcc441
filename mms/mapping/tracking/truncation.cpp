#include "mms/mapping/tracking/truncation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mms {
namespace {

/// [px]: pixels without a return beside a boundary. Source: the shadow that a structured-light
/// camera of 7.5 cm baseline leaves beside an occluder, at 580 px focal length: 4 px from 3 to 4 m.
constexpr int kMaxGap = 4;

/// [m]: distance of an occluder before the object. Source: an arm before its body is nearer to it.
constexpr float kMinOccluderDistance = 0.25F;

/// [-]: share of a side's boundary that has to be truncated. Source: by experiment on the simulated
/// scenes; a pole before a body covers less.
constexpr double kMinTruncatedShare = 0.25;

enum Side : std::size_t { kLeft, kRight, kTop, kBottom, kSideCount };

/// Boundary pixels of a part by side.
struct Boundary {
  std::array<int, kSideCount> all{};
  std::array<int, kSideCount> truncated{};
  bool is_truncated(Side side) const { return truncated[side] > kMinTruncatedShare * all[side]; }
};

class BoundaryCounter {
 public:
  BoundaryCounter(const LabeledCloud& cloud, const ClusterParts& parts)
      : cloud_(cloud), part_(parts.part), boundaries_(parts.cluster.size()) {}

  std::vector<Boundary> count() {
    for (int y = 0; y < cloud_.height; ++y) scan_line(0, y, 1, 0, cloud_.width, kLeft, kRight);
    for (int x = 0; x < cloud_.width; ++x) scan_line(x, 0, 0, 1, cloud_.height, kTop, kBottom);
    return std::move(boundaries_);
  }

 private:
  /// The first and the last pixel of every part along a row or column are its boundary there.
  void scan_line(int x, int y, int dx, int dy, int length, Side low, Side high) {
    ends_.assign(boundaries_.size(), {-1, -1});
    for (int i = 0; i < length; ++i) {
      const int c = part_[cloud_.index(x + i * dx, y + i * dy)];
      if (c < 0) continue;
      auto& [first, last] = ends_[static_cast<std::size_t>(c)];
      if (first < 0) first = i;
      last = i;
    }
    for (std::size_t c = 0; c < boundaries_.size(); ++c) {
      const auto [first, last] = ends_[c];
      if (first < 0) continue;
      count(c, low, x + first * dx, y + first * dy, -dx, -dy);
      count(c, high, x + last * dx, y + last * dy, dx, dy);
    }
  }

  void count(std::size_t part, Side side, int x, int y, int dx, int dy) {
    ++boundaries_[part].all[side];
    if (ends_at_border_or_occluder(x, y, dx, dy)) ++boundaries_[part].truncated[side];
  }

  bool ends_at_border_or_occluder(int x, int y, int dx, int dy) const {
    const float z = cloud_.points[cloud_.index(x, y)].z();
    for (int step = 1; step <= kMaxGap; ++step) {
      const int nx = x + step * dx;
      const int ny = y + step * dy;
      if (nx < 0 || ny < 0 || nx >= cloud_.width || ny >= cloud_.height) return true;
      const float beside = cloud_.points[cloud_.index(nx, ny)].z();
      if (std::isfinite(beside)) return beside < z - kMinOccluderDistance;
    }
    return false;
  }

  const LabeledCloud& cloud_;
  const std::vector<std::int16_t>& part_;
  std::vector<Boundary> boundaries_;
  std::vector<std::pair<int, int>> ends_;
};

}  // namespace

std::vector<ObjectMeasurement::Truncation> find_truncations(const LabeledCloud& cloud,
                                                            const ClusterParts& parts) {
  std::vector<ObjectMeasurement::Truncation> truncations;
  for (const Boundary& boundary : BoundaryCounter(cloud, parts).count()) {
    truncations.push_back({boundary.is_truncated(kLeft), boundary.is_truncated(kRight),
                           boundary.is_truncated(kTop), boundary.is_truncated(kBottom)});
  }
  return truncations;
}

}  // namespace mms
