#include "mms/evaluation/segmentation/mask_agreement.hpp"

#include "mms/evaluation/scores/statistics.hpp"

namespace mms {

void MaskAgreement::add(const Image<std::uint8_t>& mask, const LabeledCloud& cloud) {
  if (mask.empty() || cloud.width == 0) return;
  const int stride = mask.width() / cloud.width;  // mask pixels per side of a point's block
  if (stride < 1 || mask.height() / stride != cloud.height) return;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const PointLabel label = cloud.labels[cloud.index(x, y)];
      if (label == PointLabel::kInvalid) continue;
      const bool dynamic = label == PointLabel::kDynamic;
      const bool masked = mask(stride * x + stride / 2, stride * y + stride / 2) != 0;
      hits += masked && dynamic ? 1 : 0;
      missed += masked && !dynamic ? 1 : 0;
      extra += !masked && dynamic ? 1 : 0;
    }
  }
}

double MaskAgreement::recall() const {
  return ratio(hits, hits + missed);
}

double MaskAgreement::precision() const {
  return ratio(hits, hits + extra);
}

std::vector<MetricValue> metric_values(const MaskAgreement& agreement) {
  return {{"recall_pct", "recall of points in masks", 100.0 * agreement.recall(), "%", 1},
          {"precision_pct", "precision of dynamic points", 100.0 * agreement.precision(), "%", 1}};
}

}  // namespace mms
