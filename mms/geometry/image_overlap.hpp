#pragma once

#include "mms/core/image.hpp"

namespace mms {

/// Statistics of the pixels that two images have in common at a shift.
struct ImageOverlap {
  double count = 0.0;
  double variance_a = 0.0;
  double variance_b = 0.0;
  double covariance = 0.0;

  /// Pearson's, in [-1, 1]; 0 if an image has one value there.
  double correlation() const;
};

/// Compares a(x, y) with b(x + dx, y + dy), but for pixels that are NaN.
/// @param dx, dy  [px]
ImageOverlap image_overlap(const Image<float>& a, const Image<float>& b, int dx, int dy);

}  // namespace mms
