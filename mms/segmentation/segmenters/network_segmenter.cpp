#include "mms/segmentation/segmenters/network_segmenter.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::array<std::string_view, 5> kPeople = {"person", "people", "pedestrian", "human",
                                                     "worker"};
constexpr std::array<std::string_view, 11> kVehicles = {
    "agv", "amr", "forklift", "robot",      "vehicle", "car",
    "bus", "van", "truck",    "motorcycle", "bicycle"};

/// The name with small letters, as models for one site are often trained with `Person`.
std::string small_letters(std::string name) {
  for (char& letter : name) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return name;
}

}  // namespace

void NetworkSegmenterConfig::visit(ConfigVisitor& v) {
  v.number({"score", "", "smallest score of a dynamic object"}, score, {0.0, 1.0});
  v.boolean({"person", "", "whether people count as dynamic"}, person);
  v.boolean({"agv", "", "whether vehicles count as dynamic"}, agv);
}

std::optional<ObjectClass> object_class_of(const std::string& name) {
  const std::string small = small_letters(name);
  if (std::find(kPeople.begin(), kPeople.end(), small) != kPeople.end()) {
    return ObjectClass::kPerson;
  }
  const bool vehicle = std::find(kVehicles.begin(), kVehicles.end(), small) != kVehicles.end();
  return vehicle ? std::optional(ObjectClass::kAgv) : std::nullopt;
}

NetworkSegmenter::NetworkSegmenter(std::unique_ptr<Detector> detector,
                                   const NetworkSegmenterConfig& config)
    : detector_(std::move(detector)), config_(config) {
  bool any = false;
  for (const std::string& name : detector_->classes()) {
    std::optional<ObjectClass> meant = object_class_of(name);
    const bool enabled = meant == ObjectClass::kPerson ? config.person : config.agv;
    if (!enabled) meant.reset();
    classes_.push_back(meant);
    any = any || meant.has_value();
  }
  if (any) return;
  throw DataError("the network", "detects no dynamic class",
                  "its classes must include person or agv, and segmentation.person or "
                  "segmentation.agv must be true");
}

Segmentation NetworkSegmenter::segment(const Frame& frame) {
  Segmentation segmentation{frame.color.width(), frame.color.height(), {}};
  if (frame.color.empty()) return segmentation;
  for (Detection& detection : detector_->detect(frame.color)) {
    const auto meant = classes_[static_cast<std::size_t>(detection.category)];
    if (!meant || detection.score < static_cast<float>(config_.score)) continue;
    segmentation.instances.push_back(
        {*meant, detection.score, detection.x, detection.y, std::move(detection.mask)});
  }
  return segmentation;
}

}  // namespace mms
