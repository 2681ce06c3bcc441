#include "mms/dataset/simulated/instance_annotations.hpp"

namespace mms {

CocoDataset empty_annotations() {
  CocoDataset dataset;
  for (int i = 0; i < kObjectClassCount; ++i) {
    dataset.categories.push_back({1 + i, std::string(to_string(static_cast<ObjectClass>(i)))});
  }
  return dataset;
}

void annotate(CocoDataset& dataset, const SimulatedFrame& frame, std::int64_t image_id,
              const std::string& file_name, const AnnotationLimits& limits) {
  const Image<std::uint8_t>& instances = frame.exact.object;
  dataset.images.push_back({image_id, file_name, instances.width(), instances.height()});
  for (const ObjectTruth& object : frame.objects) {
    if (object.pixels < limits.min_pixels) continue;
    const Rle mask = encode_rle(instances, static_cast<std::uint8_t>(1 + object.id));
    const auto pixels = static_cast<int>(rle_area(mask));
    if (pixels < limits.min_pixels) continue;
    CocoAnnotation annotation =
        coco_annotation(static_cast<std::int64_t>(dataset.annotations.size()) + 1, image_id,
                        1 + static_cast<int>(object.object_class), mask);
    annotation.iscrowd =
        pixels < limits.min_clear_pixels || object.occlusion > limits.max_occlusion;
    dataset.annotations.push_back(std::move(annotation));
  }
}

}  // namespace mms
