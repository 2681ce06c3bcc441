#include "mms/evaluation/segmentation/segmentation_scores.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mms/evaluation/scores/metric_json.hpp"

namespace mms {
namespace {

struct Field {
  const char* key;
  const char* meaning;
  double SegmentationScores::*value;
};

constexpr std::array kFields = {
    Field{"AP", "average precision", &SegmentationScores::ap},
    Field{"AP50", "AP at IoU 0.50", &SegmentationScores::ap50},
    Field{"AP75", "AP at IoU 0.75", &SegmentationScores::ap75},
    Field{"APs", "AP of small objects", &SegmentationScores::ap_small},
    Field{"APm", "AP of medium objects", &SegmentationScores::ap_medium},
    Field{"APl", "AP of large objects", &SegmentationScores::ap_large},
    Field{"AR1", "recall, 1 detection per image", &SegmentationScores::ar1},
    Field{"AR10", "recall, 10 detections per image", &SegmentationScores::ar10},
    Field{"AR100", "recall, 100 detections per image", &SegmentationScores::ar100},
    Field{"ARs", "recall of small objects", &SegmentationScores::ar_small},
    Field{"ARm", "recall of medium objects", &SegmentationScores::ar_medium},
    Field{"ARl", "recall of large objects", &SegmentationScores::ar_large}};

constexpr std::size_t kColumn = 7;  // table column [characters]

std::string blanks(std::size_t width, const std::string& text) {
  return std::string(width - std::min(width, text.size()), ' ');
}

std::string right_aligned(const std::string& text) {
  return blanks(kColumn, text) + text;
}

std::string table_line(const std::string& name, std::size_t width,
                       const SegmentationScores& scores) {
  std::string line = name + blanks(width, name);
  for (const Field& field : kFields) line += right_aligned(to_fixed(scores.*field.value, 3));
  return line + "\n";
}

}  // namespace

SegmentationScores mean_scores(std::span<const ClassScores> classes) {
  SegmentationScores mean;
  for (const Field& field : kFields) {
    double sum = 0.0;
    double count = 0.0;
    for (const ClassScores& one : classes) {
      const double value = one.scores.*field.value;
      if (std::isnan(value)) continue;
      sum += value;
      count += 1.0;
    }
    mean.*field.value = sum / count;  // 0 / 0 is NaN
  }
  return mean;
}

std::vector<MetricValue> metric_values(const SegmentationScores& scores) {
  std::vector<MetricValue> values;
  values.reserve(kFields.size());
  for (const Field& field : kFields) {
    values.push_back({field.key, field.meaning, scores.*field.value, "", 3});
  }
  return values;
}

std::string to_json(const SegmentationErrors& errors) {
  nlohmann::ordered_json json = json_object(metric_values(errors.all));
  nlohmann::ordered_json classes = nlohmann::ordered_json::object();
  for (const ClassScores& one : errors.per_class) {
    classes[one.name] = json_object(metric_values(one.scores));
  }
  json["per_class"] = std::move(classes);
  return json.dump();
}

std::string to_table(const SegmentationErrors& errors) {
  const std::string title = "class";
  std::size_t width = title.size();
  for (const ClassScores& one : errors.per_class) width = std::max(width, one.name.size());
  std::string table = title + blanks(width, title);
  for (const Field& field : kFields) table += right_aligned(field.key);
  table += "\n";
  for (const ClassScores& one : errors.per_class) table += table_line(one.name, width, one.scores);
  return table + table_line("all", width, errors.all);
}

}  // namespace mms
