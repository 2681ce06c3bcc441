#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mms/evaluation/segmentation/segmentation_error.hpp"
#include "mms/segmentation/solo/solo_decoder.hpp"
#include "mms/training/data/data_files.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// Detects the objects of an image.
using DetectFunction = std::function<std::vector<Detection>(const Image<Rgb>&)>;

/// Images with ground truth for validation.
class ValidationSet {
 public:
  /// Evenly spaced images of a set, at most `most`.
  /// @param faults  what cannot be used is left out and appended
  /// @throws FileError, DataError as `list_images`, or if more than half of the images cannot be
  /// read.
  ValidationSet(const TrainingData& set, const std::vector<std::string>& classes, int most,
                CocoFaults& faults);

  /// The annotation file's folder, and the split.
  const std::string& name() const { return name_; }

  /// Mask AP of `detect`; NaN for classes without objects in the set.
  SegmentationErrors measure(const DetectFunction& detect) const;

 private:
  void add(const DataImage& source);

  std::string name_;
  CocoDataset truth_;
  std::vector<Image<Rgb>> images_;
};

}  // namespace mms
