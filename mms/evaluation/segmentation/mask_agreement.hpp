#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// How well the points held for dynamic agree with given masks, summed over frames. Pixels without
/// depth do not count.
struct MaskAgreement {
  std::int64_t hits = 0;    ///< in the masks and dynamic
  std::int64_t missed = 0;  ///< in the masks and not dynamic
  std::int64_t extra = 0;   ///< dynamic, but in no mask

  /// Adds a frame; nothing when its cloud is not organised. A point stands for a block of pixels,
  /// and is compared with the block's center one.
  /// @param mask  0 static, any other value dynamic
  void add(const Image<std::uint8_t>& mask, const LabeledCloud& cloud);

  /// Share of the masks' points that are dynamic; NaN where the masks have none.
  double recall() const;
  /// Share of the dynamic points that are in a mask; NaN where there is none.
  double precision() const;
};

/// `recall` and `precision` [%].
std::vector<MetricValue> metric_values(const MaskAgreement& agreement);

}  // namespace mms
