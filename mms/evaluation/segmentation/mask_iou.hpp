#pragma once

#include <array>
#include <cstdint>

#include "mms/io/image/rle.hpp"

namespace mms {

/// Number of pixels in both masks, in time linear in the runs. The masks must have equal size.
std::uint64_t mask_intersection(const Rle& a, const Rle& b);

/// A mask with precomputed area and box. References the runs, which have to outlive it.
struct MeasuredMask {
  explicit MeasuredMask(const Rle& mask);

  const Rle* runs;
  std::uint64_t area;         ///< [px]
  std::array<double, 4> box;  ///< x, y, width, height [px]
};

/// Intersection over union of a detection and a ground-truth object, in [0, 1]; for a crowd,
/// intersection over the detection's area, since its mask contains many objects. 0 for empty masks.
double mask_iou(const MeasuredMask& detection, const MeasuredMask& truth, bool crowd);

}  // namespace mms
