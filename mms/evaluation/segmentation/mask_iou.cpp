#include "mms/evaluation/segmentation/mask_iou.hpp"

#include <algorithm>

namespace mms {
namespace {

using Box = std::array<double, 4>;

bool apart(const Box& a, const Box& b) {
  return a[0] + a[2] <= b[0] || b[0] + b[2] <= a[0] || a[1] + a[3] <= b[1] || b[1] + b[3] <= a[1];
}

/// Iterates over the runs of a mask.
class RunWalk {
 public:
  explicit RunWalk(const Rle& mask) : counts_(mask.counts), end_(done() ? 0 : counts_[0]) {}

  bool done() const { return index_ == counts_.size(); }
  bool inside() const { return index_ % 2 == 1; }
  std::uint64_t end() const { return end_; }
  void next() {
    if (++index_ < counts_.size()) end_ += counts_[index_];
  }

 private:
  const std::vector<std::uint32_t>& counts_;
  std::size_t index_ = 0;
  std::uint64_t end_;  ///< first pixel after the run, column-major
};

}  // namespace

std::uint64_t mask_intersection(const Rle& a, const Rle& b) {
  RunWalk walk_a(a);
  RunWalk walk_b(b);
  std::uint64_t common = 0;
  std::uint64_t position = 0;
  while (!walk_a.done() && !walk_b.done()) {
    const std::uint64_t end = std::min(walk_a.end(), walk_b.end());
    if (walk_a.inside() && walk_b.inside()) common += end - position;
    position = end;
    (walk_a.end() == end ? walk_a : walk_b).next();
  }
  return common;
}

MeasuredMask::MeasuredMask(const Rle& mask)
    : runs(&mask), area(rle_area(mask)), box(rle_box(mask)) {}

double mask_iou(const MeasuredMask& detection, const MeasuredMask& truth, bool crowd) {
  if (apart(detection.box, truth.box)) return 0.0;
  const std::uint64_t common = mask_intersection(*detection.runs, *truth.runs);
  if (common == 0) return 0.0;
  const std::uint64_t all = crowd ? detection.area : detection.area + truth.area - common;
  return static_cast<double>(common) / static_cast<double>(all);
}

}  // namespace mms
