#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "mms/dataset/simulated/instance_annotations.hpp"

namespace mms {

/// Options of `write_training_set`.
struct TrainingSetOptions {
  int images = 0;  ///< of the whole set
  std::uint64_t seed = 1;
  AnnotationLimits limits;
  int jpeg_quality = 92;  ///< in [0, 100]
  /// Called after every rendered image; `done` includes existing images. Returning false ends the
  /// set.
  std::function<bool(int done, int fresh)> progress;
};

/// Summary of a training set.
struct WrittenTrainingSet {
  int images = 0;
  int fresh = 0;                ///< images rendered by this call
  std::size_t annotations = 0;  ///< objects
  std::size_t crowd = 0;        ///< of these, marked iscrowd
};

/// Writes single images with people and vehicles (TrainingViews) as images/000000.jpg, ... and
/// their COCO annotations as annotations.json. An unfinished set is continued: parts/ contains the
/// annotations of the finished images, training_set.json the seed.
/// @throws FileError if the folder cannot be written or contains other files; DataError if it
/// contains a set with another seed or is damaged.
WrittenTrainingSet write_training_set(const std::filesystem::path& folder,
                                      const TrainingSetOptions& options);

}  // namespace mms
