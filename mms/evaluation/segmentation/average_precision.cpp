#include "mms/evaluation/segmentation/average_precision.hpp"

#include <algorithm>
#include <limits>

namespace mms {
namespace {

constexpr std::array kRecalls = linspace<101>(0.0, 1.0);

/// Highest precision at or after the i-th hit. Between hits the precision only decreases, so the
/// other points of the curve are not needed.
std::vector<double> precision_from_hit(const std::vector<Verdict>& verdicts) {
  std::vector<double> precision;
  double hits = 0.0;
  double false_alarms = 0.0;
  for (const Verdict verdict : verdicts) {
    if (verdict == Verdict::kFalseAlarm) false_alarms += 1.0;
    if (verdict != Verdict::kHit) continue;
    hits += 1.0;
    precision.push_back(hits / (false_alarms + hits + std::numeric_limits<double>::epsilon()));
  }
  for (std::size_t i = precision.size(); i > 1; --i) {
    precision[i - 2] = std::max(precision[i - 2], precision[i - 1]);
  }
  return precision;
}

}  // namespace

PrecisionRecall average_precision(const std::vector<Verdict>& verdicts, std::size_t objects) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (objects == 0) return {kNone, kNone};
  const std::vector<double> precision = precision_from_hit(verdicts);
  const auto recall_with = [objects](std::size_t hits) {
    return static_cast<double>(hits) / static_cast<double>(objects);
  };
  double sum = 0.0;
  std::size_t hit = 0;  // the first that reaches the recall
  for (const double recall : kRecalls) {
    while (hit < precision.size() && recall_with(hit + 1) < recall) ++hit;
    if (hit == precision.size()) break;
    sum += precision[hit];
  }
  return {sum / static_cast<double>(kRecalls.size()), recall_with(precision.size())};
}

}  // namespace mms
