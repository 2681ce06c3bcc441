#include "mms/segmentation/onnx/yolo_boxes.hpp"

#include <algorithm>
#include <cmath>

namespace mms::onnx {
namespace {

YoloBox box_of(const float* predictions, const YoloLayout& layout, int object) {
  const auto value = [&](int channel) { return predictions[layout.index(object, channel)]; };
  YoloBox box;
  box.object = object;
  box.left = value(0) - value(2) / 2;
  box.right = value(0) + value(2) / 2;
  box.top = value(1) - value(3) / 2;
  box.bottom = value(1) + value(3) / 2;
  return box;
}

bool has_area(const YoloBox& box) {
  return std::isfinite(box.left) && std::isfinite(box.right) && std::isfinite(box.top) &&
         std::isfinite(box.bottom) && box.left < box.right && box.top < box.bottom;
}

/// The most probable class with its probability.
void choose_class(const float* predictions, const YoloLayout& layout, YoloBox& box) {
  for (int category = 0; category < layout.classes; ++category) {
    const float probability =
        predictions[layout.index(box.object, layout.first_class() + category)];
    if (!(probability > box.score)) continue;
    box.score = probability;
    box.category = category;
  }
}

float area(const YoloBox& box) {
  return (box.right - box.left) * (box.bottom - box.top);
}

float intersection_over_union(const YoloBox& a, const YoloBox& b) {
  const float width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const float height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  const float common = std::max(0.0F, width) * std::max(0.0F, height);
  return common / (area(a) + area(b) - common);
}

}  // namespace

std::vector<YoloBox> likely_boxes(const float* predictions, const YoloLayout& layout, float least) {
  std::vector<YoloBox> boxes;
  for (int object = 0; object < layout.objects; ++object) {
    const float objectness =
        layout.has_objectness() ? predictions[layout.index(object, YoloLayout::kBox)] : 1.0F;
    if (!(objectness > least)) continue;
    YoloBox box = box_of(predictions, layout, object);
    choose_class(predictions, layout, box);
    box.score = std::min(1.0F, box.score * objectness);
    if (box.score > least && has_area(box)) boxes.push_back(box);
  }
  return boxes;
}

std::vector<YoloBox> suppress_boxes(std::vector<YoloBox> boxes, float overlap, int most) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const YoloBox& a, const YoloBox& b) { return a.score > b.score; });
  std::vector<YoloBox> kept;
  for (const YoloBox& box : boxes) {
    if (kept.size() == static_cast<std::size_t>(most)) break;
    const bool covered = std::any_of(kept.begin(), kept.end(), [&](const YoloBox& better) {
      return better.category == box.category && intersection_over_union(better, box) > overlap;
    });
    if (!covered) kept.push_back(box);
  }
  return kept;
}

}  // namespace mms::onnx
