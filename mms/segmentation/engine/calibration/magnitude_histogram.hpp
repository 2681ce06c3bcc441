#pragma once

#include <cstdint>
#include <vector>

namespace mms::engine {

/// How often values of which magnitude occur; its bins widen as larger ones come.
class MagnitudeHistogram {
 public:
  MagnitudeHistogram() : counts_(kBins, 0) {}

  void add(const float* values, int count);

  /// The magnitude at which values are best cut off to be stored in `levels` equal steps: that of
  /// the smallest mean squared error, rounding and cutting together. Positive.
  float best_range(int levels) const;

 private:
  static constexpr std::size_t kBins = 4096;

  void widen_to(float magnitude);

  std::vector<std::uint64_t> counts_;
  float top_ = 0.0F;  ///< of the last bin
};

}  // namespace mms::engine
