#include "mms/segmentation/engine/calibration/magnitude_histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mms::engine {

void MagnitudeHistogram::widen_to(float magnitude) {
  if (top_ == 0.0F) top_ = magnitude;
  while (top_ < magnitude) {
    for (std::size_t i = 0; i < kBins / 2; ++i) counts_[i] = counts_[2 * i] + counts_[2 * i + 1];
    std::fill(counts_.begin() + kBins / 2, counts_.end(), 0);
    top_ *= 2.0F;
  }
}

void MagnitudeHistogram::add(const float* values, int count) {
  float largest = 0.0F;
  for (int i = 0; i < count; ++i) largest = std::max(largest, std::abs(values[i]));
  if (largest == 0.0F || !std::isfinite(largest)) return;
  widen_to(largest);
  const float scale = static_cast<float>(kBins) / top_;
  for (int i = 0; i < count; ++i) {
    const auto bin = static_cast<std::size_t>(std::abs(values[i]) * scale);
    ++counts_[std::min(bin, kBins - 1)];
  }
}

float MagnitudeHistogram::best_range(int levels) const {
  const double width = static_cast<double>(top_) / kBins;
  // Number, sum and sum of squares of the values in bins >= i, in units of bins.
  std::vector<std::array<double, 3>> above(kBins + 1, {0.0, 0.0, 0.0});
  for (std::size_t i = kBins; i-- > 0;) {
    const auto count = static_cast<double>(counts_[i]);
    const double middle = static_cast<double>(i) + 0.5;
    above[i] = {above[i + 1][0] + count, above[i + 1][1] + count * middle,
                above[i + 1][2] + count * middle * middle};
  }
  double least = -1.0;
  std::size_t best = kBins;
  for (std::size_t cut = kBins / 64; cut <= kBins; ++cut) {
    const auto range = static_cast<double>(cut);
    const double step = range / levels;
    const auto& [count, sum, squares] = above[cut];
    // Zeros are represented exactly, so the first bin does not count.
    const double inside = above[1][0] - std::max(count, 0.0);
    const double error =
        inside * step * step / 12.0 + (squares - 2.0 * range * sum + range * range * count);
    if (least >= 0.0 && error >= least) continue;
    least = error;
    best = cut;
  }
  return std::max(static_cast<float>(static_cast<double>(best) * width), 1e-6F);
}

}  // namespace mms::engine
