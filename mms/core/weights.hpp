#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mms {

/// A dense row-major tensor of a network.
struct WeightTensor {
  std::vector<std::int64_t> shape;  ///< empty for a single number
  std::vector<float> values;        ///< as many as the product of `shape`

  bool operator==(const WeightTensor&) const = default;
};

/// A trained network as plain data: what a weights file holds and a network is filled from.
struct Weights {
  std::map<std::string, std::string> metadata;  ///< free texts beside the tensors
  std::map<std::string, WeightTensor> tensors;  ///< by their parameter's name

  bool operator==(const Weights&) const = default;
};

}  // namespace mms
