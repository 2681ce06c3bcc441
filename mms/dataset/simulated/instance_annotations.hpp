#pragma once

#include <string>

#include "mms/io/image/coco_io.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// Which objects of an image are annotated and evaluated.
struct AnnotationLimits {
  int min_pixels = 20;  ///< visible; objects with fewer are skipped
  int min_clear_pixels =
      60;  ///< objects with fewer are marked iscrowd and ignored in the evaluation
  double max_occlusion = 0.9;  ///< objects with more occlusion are marked iscrowd as well
};

/// A dataset without images and with the categories person = 1 and agv = 2.
CocoDataset empty_annotations();

/// Adds an image and its visible objects, with consecutive ids.
/// @param image_id   not yet in the dataset
/// @param file_name  of the image, relative to the folder of the annotations
void annotate(CocoDataset& dataset, const SimulatedFrame& frame, std::int64_t image_id,
              const std::string& file_name, const AnnotationLimits& limits = {});

}  // namespace mms
