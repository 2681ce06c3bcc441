#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/segmentation/detection/detector.hpp"
#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {

/// Which of the objects that a network finds count as potentially dynamic.
struct NetworkSegmenterConfig {
  double score = 0.3;  ///< smallest
  bool person = true;  ///< whether people count
  bool agv = true;     ///< whether vehicles count

  /// Declares the settings.
  void visit(ConfigVisitor& v);
};

/// The class that a network's own name for it means: "person", and "agv", "forklift", "truck" and
/// other vehicles of COCO; nothing for all else.
std::optional<ObjectClass> object_class_of(const std::string& name);

/// Segments frames with a network (III-A). Frames without a picture have no instances.
class NetworkSegmenter : public Segmenter {
 public:
  /// @throws DataError when none of the detector's classes is wanted.
  NetworkSegmenter(std::unique_ptr<Detector> detector, const NetworkSegmenterConfig& config);

  Segmentation segment(const Frame& frame) override;

 private:
  std::unique_ptr<Detector> detector_;
  NetworkSegmenterConfig config_;
  std::vector<std::optional<ObjectClass>> classes_;  ///< of the detector's categories, if wanted
};

}  // namespace mms
