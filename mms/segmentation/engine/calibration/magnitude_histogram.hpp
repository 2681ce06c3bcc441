#pragma once

#include <cstdint>
#include <vector>

namespace mms::engine {

/// Histogram of magnitudes; its bins widen for larger values.
class MagnitudeHistogram {
 public:
  MagnitudeHistogram() : counts_(kBins, 0) {}

  void add(const float* values, int count);

  /// The clipping magnitude for `levels` equal steps with the least mean squared error of rounding
  /// and clipping. Positive.
  float best_range(int levels) const;

 private:
  static constexpr std::size_t kBins = 4096;

  void widen_to(float magnitude);

  std::vector<std::uint64_t> counts_;
  float top_ = 0.0F;  ///< upper bound of the last bin
};

}  // namespace mms::engine
