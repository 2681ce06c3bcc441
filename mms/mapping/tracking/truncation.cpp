#include "mms/mapping/tracking/truncation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mms {
namespace {

constexpr int kGap = 4;             // pixels without a return that a boundary may have beside it
constexpr float kNearer = 0.25F;    // by which an occluder is before the object [m]
constexpr double kCutShare = 0.25;  // of a side's boundary

enum Side : std::size_t { kLeft, kRight, kTop, kBottom, kSideCount };

/// Boundary pixels of a part by side.
struct Boundary {
  std::array<int, kSideCount> all{};
  std::array<int, kSideCount> truncation{};
  bool is_truncated(Side side) const { return truncation[side] > kCutShare * all[side]; }
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
      const int c = part_[index(x + i * dx, y + i * dy)];
      if (c < 0) continue;
      auto& [first, last] = ends_[static_cast<std::size_t>(c)];
      if (first < 0) first = i;
      last = i;
    }
    for (std::size_t c = 0; c < boundaries_.size(); ++c) {
      const auto [first, last] = ends_[c];
      if (first < 0) continue;
      note(c, low, x + first * dx, y + first * dy, -dx, -dy);
      note(c, high, x + last * dx, y + last * dy, dx, dy);
    }
  }

  void note(std::size_t part, Side side, int x, int y, int dx, int dy) {
    ++boundaries_[part].all[side];
    if (ends_at_border_or_occluder(x, y, dx, dy)) ++boundaries_[part].truncation[side];
  }

  bool ends_at_border_or_occluder(int x, int y, int dx, int dy) const {
    const float z = cloud_.points[index(x, y)].z();
    for (int step = 1; step <= kGap; ++step) {
      const int nx = x + step * dx;
      const int ny = y + step * dy;
      if (nx < 0 || ny < 0 || nx >= cloud_.width || ny >= cloud_.height) return true;
      const float beside = cloud_.points[index(nx, ny)].z();
      if (std::isfinite(beside)) return beside < z - kNearer;
    }
    return false;
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * cloud_.width + x); }

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
