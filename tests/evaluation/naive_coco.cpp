#include "tests/evaluation/naive_coco.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mms::test {
namespace {

const std::vector<double> kThresholds = {
    0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.8999999999999999, 0.95};

struct Range {
  double min, max;
};
const Range kAll = {0, 1e10};
const Range kSmall = {0, 1024};
const Range kMedium = {1024, 9216};
const Range kLarge = {9216, 1e10};

/// One class, threshold, range and number of results.
struct Query {
  int category;
  double threshold;
  Range range;
  std::size_t max_results;
};

struct Truth {
  CocoAnnotation object;
  bool ignored;
  bool matched = false;
};

struct Found {
  CocoResult result;
  bool matched = false;
  bool ignored = false;
};

struct Scores {
  double precision = -1.0;
  double recall = -1.0;
};

double naive_iou(const Rle& detection, const CocoAnnotation& object) {
  const Image<std::uint8_t> d = decode_rle(detection);
  const Image<std::uint8_t> g = decode_rle(object.segmentation);
  int both = 0;
  int any = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d[i] != 0 && g[i] != 0) ++both;
    if (d[i] != 0 || (g[i] != 0 && !object.iscrowd)) ++any;
  }
  return both == 0 ? 0.0 : static_cast<double>(both) / any;
}

bool outside(double area, const Range& range) {
  return area < range.min || area > range.max;
}

bool higher(const Found& a, const Found& b) {
  return a.result.score > b.result.score;
}

void match(std::vector<Found>& found, std::vector<Truth>& truth, const Query& query) {
  for (Found& d : found) {
    double iou = std::min(query.threshold, 1 - 1e-10);
    int m = -1;
    for (int g = 0; g < static_cast<int>(truth.size()); ++g) {
      const Truth& object = truth[static_cast<std::size_t>(g)];
      if (object.matched && !object.object.iscrowd) continue;
      if (m > -1 && !truth[static_cast<std::size_t>(m)].ignored && object.ignored) break;
      const double overlap = naive_iou(d.result.segmentation, object.object);
      if (overlap < iou) continue;
      iou = overlap;
      m = g;
    }
    d.matched = m > -1;
    if (d.matched) {
      d.ignored = truth[static_cast<std::size_t>(m)].ignored;
      truth[static_cast<std::size_t>(m)].matched = true;
    } else {
      d.ignored = outside(static_cast<double>(rle_area(d.result.segmentation)), query.range);
    }
  }
}

std::vector<Truth> truth_of(const CocoDataset& dataset, std::int64_t image, const Query& query) {
  std::vector<Truth> truth;
  for (const CocoAnnotation& object : dataset.annotations) {
    if (object.image_id != image || object.category_id != query.category) continue;
    truth.push_back({object, object.iscrowd || outside(object.area, query.range)});
  }
  std::stable_sort(truth.begin(), truth.end(),
                   [](const Truth& a, const Truth& b) { return !a.ignored && b.ignored; });
  return truth;
}

std::vector<Found> found_in(const std::vector<CocoResult>& results, std::int64_t image,
                            const Query& query) {
  std::vector<Found> found;
  for (const CocoResult& result : results) {
    if (result.image_id == image && result.category_id == query.category) {
      found.push_back({result});
    }
  }
  std::stable_sort(found.begin(), found.end(), higher);
  if (found.size() > 100) found.resize(100);
  return found;
}

Scores accumulate(const std::vector<Found>& found, int objects) {
  std::vector<double> rc;
  std::vector<double> pr;
  double tp = 0;
  double fp = 0;
  for (const Found& d : found) {
    if (d.matched && !d.ignored) ++tp;
    if (!d.matched && !d.ignored) ++fp;
    rc.push_back(tp / objects);
    pr.push_back(tp / (fp + tp + std::numeric_limits<double>::epsilon()));
  }
  for (std::size_t i = pr.size(); i-- > 1;) pr[i - 1] = std::max(pr[i - 1], pr[i]);
  double sum = 0;
  for (int r = 0; r <= 100; ++r) {
    const auto at = std::lower_bound(rc.begin(), rc.end(), r * 0.01);
    if (at != rc.end()) sum += pr[static_cast<std::size_t>(at - rc.begin())];
  }
  return {sum / 101, rc.empty() ? 0.0 : rc.back()};
}

Scores evaluate(const CocoDataset& dataset, const std::vector<CocoResult>& results,
                const Query& query) {
  std::set<std::int64_t> images;
  for (const CocoImage& image : dataset.images) images.insert(image.id);
  std::vector<Found> all;
  int objects = 0;
  for (const std::int64_t image : images) {
    std::vector<Truth> truth = truth_of(dataset, image, query);
    std::vector<Found> found = found_in(results, image, query);
    match(found, truth, query);
    if (found.size() > query.max_results) found.resize(query.max_results);
    all.insert(all.end(), found.begin(), found.end());
    for (const Truth& object : truth) objects += object.ignored ? 0 : 1;
  }
  if (objects == 0) return {};
  std::stable_sort(all.begin(), all.end(), higher);
  return accumulate(all, objects);
}

}  // namespace

SegmentationScores naive_scores(const CocoDataset& truth, const std::vector<CocoResult>& results) {
  const auto mean = [&](double Scores::*number, const std::vector<double>& thresholds,
                        const Range& range, std::size_t max_results) {
    double sum = 0;
    double count = 0;
    for (const CocoCategory& category : truth.categories) {
      for (const double threshold : thresholds) {
        const double value =
            evaluate(truth, results, {category.id, threshold, range, max_results}).*number;
        if (value < 0) continue;
        sum += value;
        ++count;
      }
    }
    return sum / count;
  };
  const auto precision = &Scores::precision;
  const auto recall = &Scores::recall;
  return {.ap = mean(precision, kThresholds, kAll, 100),
          .ap50 = mean(precision, {0.5}, kAll, 100),
          .ap75 = mean(precision, {0.75}, kAll, 100),
          .ap_small = mean(precision, kThresholds, kSmall, 100),
          .ap_medium = mean(precision, kThresholds, kMedium, 100),
          .ap_large = mean(precision, kThresholds, kLarge, 100),
          .ar1 = mean(recall, kThresholds, kAll, 1),
          .ar10 = mean(recall, kThresholds, kAll, 10),
          .ar100 = mean(recall, kThresholds, kAll, 100),
          .ar_small = mean(recall, kThresholds, kSmall, 100),
          .ar_medium = mean(recall, kThresholds, kMedium, 100),
          .ar_large = mean(recall, kThresholds, kLarge, 100)};
}

}  // namespace mms::test
