#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "mms/dataset/simulated/instance_annotations.hpp"

namespace mms {

/// What `write_training_set` is to write.
struct TrainingSetOptions {
  int images = 0;  ///< of the whole set
  std::uint64_t seed = 1;
  AnnotationLimits limits;
  int jpeg_quality = 92;  ///< in [0, 100]
  /// Called after every image that was not there before; `done` counts those that were too. The set
  /// ends early when it returns false.
  std::function<bool(int done, int fresh)> progress;
};

/// What a training set holds.
struct WrittenTrainingSet {
  int images = 0;
  int fresh = 0;                ///< of them, rendered now
  std::size_t annotations = 0;  ///< objects
  std::size_t crowd = 0;        ///< of them, marked iscrowd
};

/// Writes single images with people and vehicles (TrainingViews) as images/000000.jpg, ... and
/// their COCO annotations as annotations.json. A set that was left unfinished is continued: parts/
/// has the annotations of every image done, training_set.json the seed they are of.
/// @throws FileError when the folder cannot be written to or holds something else; DataError when
///         it holds a set of another seed, or parts of it are damaged.
WrittenTrainingSet write_training_set(const std::filesystem::path& folder,
                                      const TrainingSetOptions& options);

}  // namespace mms
