#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Which detected objects count as potentially dynamic.
struct NetworkSegmenterConfig {
  double score = 0.3;  ///< smallest score
  bool person = true;  ///< whether people are dynamic
  bool agv = true;     ///< whether vehicles are dynamic

  /// Declares the settings.
  void visit(ConfigVisitor& v);
};

/// The class of a network's class name, in large or small letters: "person", "people",
/// "pedestrian", "human" and "worker"; "agv", "amr", "forklift", "robot", "vehicle", "van" and road
/// vehicles of COCO; nullopt for others.
std::optional<ObjectClass> object_class_of(const std::string& name);

/// Segments frames with a network (III-A). Frames without an image have no instances.
class NetworkSegmenter : public Segmenter {
 public:
  /// @throws DataError if none of the detector's classes is used.
  NetworkSegmenter(std::unique_ptr<Detector> detector, const NetworkSegmenterConfig& config);

  Segmentation segment(const Frame& frame) override;

 private:
  std::unique_ptr<Detector> detector_;
  NetworkSegmenterConfig config_;
  std::vector<std::optional<ObjectClass>> classes_;  ///< of the detector's categories, if used
};

}  // namespace mms
