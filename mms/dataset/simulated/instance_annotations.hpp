#pragma once

#include <string>

#include "mms/io/image/coco_io.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {

/// Which objects of an image are annotated, and which of them count.
struct AnnotationLimits {
  int min_pixels = 20;         ///< visible ones; objects with fewer are left out
  int min_clear_pixels = 60;   ///< objects with fewer are marked iscrowd, neither hit nor miss
  double max_occlusion = 0.9;  ///< objects hidden to a larger share are marked so too
};

/// A dataset without images and with the categories person = 1 and agv = 2.
CocoDataset empty_annotations();

/// Adds an image and its visible objects, numbered on from those already there.
/// @param image_id   not yet in the dataset
/// @param file_name  of the image, below the folder of the annotations
void annotate(CocoDataset& dataset, const SimulatedFrame& frame, std::int64_t image_id,
              const std::string& file_name, const AnnotationLimits& limits = {});

}  // namespace mms
