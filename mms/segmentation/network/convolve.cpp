#include "mms/segmentation/network/convolve.hpp"

#include <array>

namespace mms::network {

torch::Tensor convolve(const torch::Tensor& x, const torch::Tensor& weight,
                       const torch::Tensor& bias, std::int64_t stride, std::int64_t dilation) {
  const std::int64_t padding = dilation * (weight.size(2) / 2);
  const bool by_onednn =
      !torch::GradMode::is_enabled() && x.is_cpu() && x.scalar_type() == torch::kFloat;
  if (!by_onednn) return torch::conv2d(x, weight, bias, stride, padding, dilation);
  const std::array<std::int64_t, 2> paddings = {padding, padding};
  const std::array<std::int64_t, 2> strides = {stride, stride};
  const std::array<std::int64_t, 2> dilations = {dilation, dilation};
  return at::mkldnn_convolution(x, weight, bias, paddings, strides, dilations, /*groups=*/1);
}

torch::Tensor convolve(const torch::Tensor& x, torch::nn::Conv2d& conv) {
  return convolve(x, conv->weight, conv->bias, (*conv->options.stride())[0],
                  (*conv->options.dilation())[0]);
}

}  // namespace mms::network
