#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// The twelve numbers of COCO's mask evaluation, in [0, 1]; NaN if no ground-truth object counts.
/// By default means over the IoU thresholds 0.50:0.05:0.95, over all sizes and the 100 highest
/// scores per image and class. Objects are small below 32^2 px and large above 96^2 px.
struct SegmentationScores {
  double ap = 0.0;         ///< average precision
  double ap50 = 0.0;       ///< at an IoU of 0.50
  double ap75 = 0.0;       ///< at an IoU of 0.75
  double ap_small = 0.0;   ///< of small objects
  double ap_medium = 0.0;  ///< of medium objects
  double ap_large = 0.0;   ///< of large objects
  double ar1 = 0.0;        ///< recall with the best detection of an image
  double ar10 = 0.0;       ///< recall with the 10 best
  double ar100 = 0.0;      ///< recall with the 100 best
  double ar_small = 0.0;   ///< recall of small objects
  double ar_medium = 0.0;  ///< recall of medium objects
  double ar_large = 0.0;   ///< recall of large objects
};

struct ClassScores {
  std::string name;
  SegmentationScores scores;
};

/// Evaluation of a network's masks.
struct SegmentationErrors {
  SegmentationScores all;              ///< mean of each number over the classes that have it
  std::vector<ClassScores> per_class;  ///< in the order of class ids
  std::size_t images = 0;              ///< evaluated
  std::size_t objects = 0;             ///< in the ground truth, including crowds
  std::size_t results = 0;             ///< in these images, of these classes
};

/// Mean of each number over the classes for which it is defined, else NaN.
SegmentationScores mean_scores(std::span<const ClassScores> classes);

/// JSON keys: AP, AP50, AP75, APs, APm, APl, AR1, AR10, AR100, ARs, ARm, ARl.
std::vector<MetricValue> metric_values(const SegmentationScores& scores);

/// One JSON object: the keys of `metric_values` for all classes, and `per_class` with the same keys
/// per class name; null if undefined.
std::string to_json(const SegmentationErrors& errors);

/// One row per class and one for all, below a header row.
std::string to_table(const SegmentationErrors& errors);

}  // namespace mms
