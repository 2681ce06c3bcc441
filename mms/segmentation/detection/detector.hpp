#pragma once

#include <string>
#include <vector>

#include "mms/segmentation/solo/solo_decoder.hpp"

namespace mms {

/// Instance-segmentation network, ready for inference.
class Detector {
 public:
  virtual ~Detector() = default;

  /// The objects in an image of any size, highest score first.
  virtual std::vector<Detection> detect(const Image<Rgb>& image) = 0;

  /// Class names in the order of `Detection::category`.
  virtual const std::vector<std::string>& classes() const = 0;
};

}  // namespace mms
