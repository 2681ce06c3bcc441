#include "mms/evaluation/segmentation/class_scores.hpp"

#include <algorithm>
#include <array>

#include "mms/evaluation/segmentation/average_precision.hpp"
#include "mms/evaluation/segmentation/mask_iou.hpp"
#include "mms/evaluation/segmentation/mask_matching.hpp"

namespace mms {
namespace {

constexpr std::size_t kMaxResults = 100;  // per class and image

/// Sizes of objects [px], both ends inclusive.
struct AreaRange {
  double min;
  double max;

  bool contains(double area) const { return area >= min && area <= max; }
};

constexpr std::array kAreaRanges = {AreaRange{0.0, 1e10}, AreaRange{0.0, 32.0 * 32.0},
                                    AreaRange{32.0 * 32.0, 96.0 * 96.0},
                                    AreaRange{96.0 * 96.0, 1e10}};
enum : std::size_t { kAll, kSmall, kMedium, kLarge };  // indices of kAreaRanges

/// A matched result.
struct Judged {
  double score;
  std::size_t rank;  ///< in its image, highest score first
  Verdicts verdicts;
};

/// Results of one class for objects of one size range.
struct RangeResult {
  std::size_t objects = 0;      ///< that count
  std::vector<Judged> results;  ///< of all images
};

std::vector<const CocoResult*> best_results(std::vector<const CocoResult*> results) {
  std::stable_sort(results.begin(), results.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  results.resize(std::min(results.size(), kMaxResults));
  return results;
}

Overlaps overlaps_of(const ClassInImage& image) {
  std::vector<MeasuredMask> objects;
  for (const CocoAnnotation* object : image.truth) objects.emplace_back(object->segmentation);
  Overlaps overlaps;
  for (const CocoResult* result : image.results) {
    const MeasuredMask mask(result->segmentation);
    std::vector<double>& row = overlaps.emplace_back();
    for (std::size_t i = 0; i < objects.size(); ++i) {
      row.push_back(mask_iou(mask, objects[i], image.truth[i]->iscrowd));
    }
  }
  return overlaps;
}

std::vector<MatchObject> match_objects(const ClassInImage& image, const AreaRange& range) {
  std::vector<MatchObject> objects;
  for (const CocoAnnotation* object : image.truth) {
    objects.push_back({object->iscrowd, object->iscrowd || !range.contains(object->area)});
  }
  return objects;
}

/// A false positive does not count if only objects of another size are evaluated.
void ignore_false_alarms(Verdicts& verdicts) {
  std::replace(verdicts.begin(), verdicts.end(), Verdict::kFalseAlarm, Verdict::kIgnored);
}

/// Adds an image with sorted results.
void add_image(const ClassInImage& image, const Overlaps& overlaps, const AreaRange& range,
               RangeResult& sum) {
  const std::vector<MatchObject> objects = match_objects(image, range);
  std::vector<Verdicts> verdicts = match_masks(overlaps, objects);
  for (std::size_t rank = 0; rank < verdicts.size(); ++rank) {
    const CocoResult& result = *image.results[rank];
    const bool in_range = range.contains(static_cast<double>(rle_area(result.segmentation)));
    if (!in_range) ignore_false_alarms(verdicts[rank]);
    sum.results.push_back({result.score, rank, verdicts[rank]});
  }
  sum.objects += static_cast<std::size_t>(std::count_if(
      objects.begin(), objects.end(), [](const MatchObject& object) { return !object.ignored; }));
}

/// One number per IoU threshold.
using Numbers = std::array<double, kIouThresholds.size()>;

double mean(const Numbers& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}

struct Curves {
  Numbers precision;
  Numbers recall;
};

/// @param range  with results sorted by score
/// @param max_results  results used per image
Curves curves_of(const RangeResult& range, std::size_t max_results) {
  Curves curves{};
  for (std::size_t i = 0; i < kIouThresholds.size(); ++i) {
    std::vector<Verdict> verdicts;
    for (const Judged& result : range.results) {
      if (result.rank < max_results) verdicts.push_back(result.verdicts[i]);
    }
    const PrecisionRecall curve = average_precision(verdicts, range.objects);
    curves.precision[i] = curve.precision;
    curves.recall[i] = curve.recall;
  }
  return curves;
}

}  // namespace

SegmentationScores class_scores(const ClassInImages& images) {
  std::array<RangeResult, kAreaRanges.size()> ranges;
  for (const auto& [id, found] : images) {
    const ClassInImage image{found.truth, best_results(found.results)};
    const Overlaps overlaps = overlaps_of(image);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      add_image(image, overlaps, kAreaRanges[i], ranges[i]);
    }
  }
  for (RangeResult& range : ranges) {
    std::stable_sort(range.results.begin(), range.results.end(),
                     [](const Judged& a, const Judged& b) { return a.score > b.score; });
  }
  const Curves all = curves_of(ranges[kAll], kMaxResults);
  const Curves small = curves_of(ranges[kSmall], kMaxResults);
  const Curves medium = curves_of(ranges[kMedium], kMaxResults);
  const Curves large = curves_of(ranges[kLarge], kMaxResults);
  return {.ap = mean(all.precision),
          .ap50 = all.precision[0],
          .ap75 = all.precision[5],
          .ap_small = mean(small.precision),
          .ap_medium = mean(medium.precision),
          .ap_large = mean(large.precision),
          .ar1 = mean(curves_of(ranges[kAll], 1).recall),
          .ar10 = mean(curves_of(ranges[kAll], 10).recall),
          .ar100 = mean(all.recall),
          .ar_small = mean(small.recall),
          .ar_medium = mean(medium.recall),
          .ar_large = mean(large.recall)};
}

}  // namespace mms
