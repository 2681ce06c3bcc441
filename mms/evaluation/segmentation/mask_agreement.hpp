#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Agreement of the points labeled dynamic with given masks, summed over frames. Pixels without
/// depth do not count.
struct MaskAgreement {
  std::int64_t hits = 0;    ///< in a mask and dynamic
  std::int64_t missed = 0;  ///< in a mask and not dynamic
  std::int64_t extra = 0;   ///< dynamic, but not in a mask

  /// Adds a frame; ignores clouds that are not organized. A point represents a block of pixels and
  /// is compared with the block's center.
  /// @param mask  0 static, any other value dynamic
  void add(const Image<std::uint8_t>& mask, const LabeledCloud& cloud);

  /// Share of the points in masks that are dynamic; NaN if there are none.
  double recall() const;
  /// Share of the dynamic points that are in a mask; NaN if there are none.
  double precision() const;
};

/// JSON keys: recall_pct, precision_pct.
std::vector<MetricValue> metric_values(const MaskAgreement& agreement);

}  // namespace mms
