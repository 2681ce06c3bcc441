#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/io/image/coco_io.hpp"
#include "mms/training/data/sample.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// Training images in memory, scaled down to a largest side.
class SampleStore {
 public:
  /// Reads all images of all sets. Categories are matched to `classes` by name; objects of other
  /// classes are ignored. What cannot be used is left out, see `faults`.
  /// @param progress  called after every image with the number of images read and the total
  /// @throws FileError, DataError if an annotation file cannot be read, a set is empty, or more
  /// than half of it cannot be used.
  SampleStore(const std::vector<TrainingData>& sets, const std::vector<std::string>& classes,
              int largest_side, const std::function<void(int, int)>& progress = {});

  std::size_t size() const { return samples_.size(); }
  const Sample& operator[](std::size_t i) const { return samples_[i]; }

  /// Images and annotations that were left out.
  const CocoFaults& faults() const { return faults_; }

  /// A random image, weighted by the sets' `repeat`.
  const Sample& draw(RandomStream& random) const;

 private:
  /// An image, or why it cannot be read.
  struct Loaded {
    Sample sample{};
    std::string fault{};
  };

  void keep_readable(const TrainingData& set, std::vector<Loaded> loaded);

  std::vector<Sample> samples_;
  CocoFaults faults_;
  std::vector<double> shares_;  ///< cumulative sum of the images' weights
};

}  // namespace mms
