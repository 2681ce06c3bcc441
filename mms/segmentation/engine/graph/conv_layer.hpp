#pragma once

#include <memory>
#include <string>
#include <vector>

namespace mms::engine {

/// A convolution for inference: norm and standardization are folded into its weights; padding keeps
/// the size at stride 1.
struct ConvLayer {
  std::string name{};  ///< of its weight in the weights file
  int in = 0;          ///< channels
  int out = 0;         ///< channels
  int kernel = 1;      ///< side [px]
  int stride = 1;      ///< [px]
  int dilation = 1;    ///< [px]
  bool relu = false;
  std::vector<float> weight{};  ///< out x in x kernel x kernel
  std::vector<float> bias{};    ///< out

  int inputs_per_output() const { return in * kernel * kernel; }
};

using ConvLayerPtr = std::shared_ptr<const ConvLayer>;

}  // namespace mms::engine
