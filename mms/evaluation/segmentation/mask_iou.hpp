#pragma once

#include <array>
#include <cstdint>

#include "mms/io/image/rle.hpp"

namespace mms {

/// Number of pixels that both masks have, counted on their runs in time linear in the runs. The
/// masks have to be of one size.
std::uint64_t mask_intersection(const Rle& a, const Rle& b);

/// A mask with what every comparison needs of it. Views the runs: they have to outlive it.
struct MeasuredMask {
  explicit MeasuredMask(const Rle& mask);

  const Rle* runs;
  std::uint64_t area;         ///< [px]
  std::array<double, 4> box;  ///< x, y, width, height [px]
};

/// Overlap of a detection and an object of the truth in [0, 1]: pixels of both by pixels of either;
/// for a crowd by pixels of the detection, since it has many objects in one mask. 0 for empty
/// masks.
double mask_iou(const MeasuredMask& detection, const MeasuredMask& truth, bool crowd);

}  // namespace mms
