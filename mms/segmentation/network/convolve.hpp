#pragma once

#include <torch/nn/modules/conv.h>

namespace mms::network {

/// torch::conv2d with square strides and dilations, padded so that the size is kept at stride 1. At
/// inference on the CPU it uses oneDNN: torch uses BLAS for small maps and 1x1 kernels, which is
/// several times slower with Debian's BLAS.
/// @param bias  may be undefined
torch::Tensor convolve(const torch::Tensor& x, const torch::Tensor& weight,
                       const torch::Tensor& bias, std::int64_t stride, std::int64_t dilation = 1);

/// The same with a module's weight, bias and options.
torch::Tensor convolve(const torch::Tensor& x, torch::nn::Conv2d& conv);

}  // namespace mms::network
