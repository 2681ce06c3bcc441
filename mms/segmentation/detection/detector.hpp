#pragma once

#include <string>
#include <vector>

#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// An instance-segmentation network ready to be asked.
class Detector {
 public:
  virtual ~Detector() = default;

  /// The objects in a picture of any size, best first.
  virtual std::vector<Detection> detect(const Image<Rgb>& image) = 0;

  /// Names of the classes, in the order of `Detection::category`.
  virtual const std::vector<std::string>& classes() const = 0;
};

}  // namespace mms
