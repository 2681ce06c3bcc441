#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mms {

/// Dense row-major tensor of a network.
struct WeightTensor {
  std::vector<std::int64_t> shape;  ///< empty for a scalar
  std::vector<float> values;        ///< as many as the product of `shape`

  bool operator==(const WeightTensor&) const = default;
};

/// Parameters of a trained network, as stored in a weights file.
struct Weights {
  std::map<std::string, std::string> metadata;  ///< free text
  std::map<std::string, WeightTensor> tensors;  ///< by parameter name

  bool operator==(const Weights&) const = default;
};

}  // namespace mms
