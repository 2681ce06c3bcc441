#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/training/data/sample.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// Training images in memory, scaled down to a largest side.
class SampleStore {
 public:
  /// Reads all images of all sets. Categories are matched to `classes` by name; objects of other
  /// classes are ignored.
  /// @param progress  called after every image with the number of images read and the total
  /// @throws FileError, DataError if annotations or an image cannot be read, or a set is empty.
  SampleStore(const std::vector<TrainingData>& sets, const std::vector<std::string>& classes,
              int largest_side, const std::function<void(int, int)>& progress = {});

  std::size_t size() const { return samples_.size(); }
  const Sample& operator[](std::size_t i) const { return samples_[i]; }

  /// A random image, weighted by the sets' `repeat`.
  const Sample& draw(RandomStream& random) const;

 private:
  std::vector<Sample> samples_;
  std::vector<double> shares_;  ///< cumulative sum of the images' weights
};

}  // namespace mms
