#include "mms/evaluation/segmentation/mask_matching.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace mms {
namespace {

/// Matches the detections of one image at one threshold, in the given order.
class Matching {
 public:
  Matching(const std::vector<MatchObject>& objects, double threshold)
      : objects_(objects),
        threshold_(threshold),
        order_(objects.size()),
        taken_(objects.size(), false) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_partition(order_.begin(), order_.end(),
                          [&](std::size_t object) { return !objects[object].ignored; });
  }

  Verdict judge(const std::vector<double>& overlaps) {
    const std::optional<std::size_t> object = best_object(overlaps);
    if (!object) return Verdict::kFalseAlarm;
    taken_[*object] = true;
    return objects_[*object].ignored ? Verdict::kIgnored : Verdict::kHit;
  }

 private:
  std::optional<std::size_t> best_object(const std::vector<double>& overlaps) const {
    std::optional<std::size_t> best;
    double highest = threshold_;
    for (const std::size_t object : order_) {
      if (taken_[object] && !objects_[object].crowd) continue;
      if (best && !objects_[*best].ignored && objects_[object].ignored) break;
      if (overlaps[object] < highest) continue;
      best = object;
      highest = overlaps[object];
    }
    return best;
  }

  const std::vector<MatchObject>& objects_;
  double threshold_;
  std::vector<std::size_t> order_;  ///< objects that count first
  std::vector<bool> taken_;
};

}  // namespace

std::vector<Verdicts> match_masks(const Overlaps& overlaps,
                                  const std::vector<MatchObject>& objects) {
  std::vector<Verdicts> verdicts(overlaps.size());
  for (std::size_t i = 0; i < kIouThresholds.size(); ++i) {
    Matching matching(objects, kIouThresholds[i]);
    for (std::size_t detection = 0; detection < overlaps.size(); ++detection) {
      verdicts[detection][i] = matching.judge(overlaps[detection]);
    }
  }
  return verdicts;
}

}  // namespace mms
