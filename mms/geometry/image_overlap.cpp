#include "mms/geometry/image_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace mms {

double ImageOverlap::correlation() const {
  const double product = variance_a * variance_b;
  return product > 0.0 ? covariance / std::sqrt(product) : 0.0;
}

ImageOverlap image_overlap(const Image<float>& a, const Image<float>& b, int dx, int dy) {
  double n = 0.0;
  double sum_a = 0.0;
  double sum_b = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (int y = std::max(0, -dy); y < std::min(a.height(), a.height() - dy); ++y) {
    for (int x = std::max(0, -dx); x < std::min(a.width(), a.width() - dx); ++x) {
      const auto p = static_cast<double>(a(x, y));
      const auto q = static_cast<double>(b(x + dx, y + dy));
      if (std::isnan(p) || std::isnan(q)) continue;
      n += 1.0;
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  }
  if (n == 0.0) return {};
  return {n, aa / n - sum_a * sum_a / (n * n), bb / n - sum_b * sum_b / (n * n),
          ab / n - sum_a * sum_b / (n * n)};
}

}  // namespace mms
