#include "mms/segmentation/network/deformable_conv.hpp"

#include <torch/nn/functional.h>

#include <vector>

namespace mms::network {
namespace {

namespace F = torch::nn::functional;

/// Values of `x` at the positions (B, oH, oW) given in pixels.
torch::Tensor sample(const torch::Tensor& x, const torch::Tensor& column,
                     const torch::Tensor& row) {
  const auto normalised = [](const torch::Tensor& pixel, std::int64_t size) {
    return (2 * pixel + 1) / static_cast<double>(size) - 1;  // align_corners = false
  };
  const torch::Tensor grid =
      torch::stack({normalised(column, x.size(3)), normalised(row, x.size(2))}, -1);
  return F::grid_sample(x, grid,
                        F::GridSampleFuncOptions()
                            .mode(torch::kBilinear)
                            .padding_mode(torch::kZeros)
                            .align_corners(false));
}

/// Position of the first tap of every output pixel, along one axis.
torch::Tensor origins(std::int64_t count, std::int64_t stride, std::int64_t dilation,
                      const torch::Tensor& like) {
  return torch::arange(count, like.options()) * stride - dilation;
}

}  // namespace

torch::Tensor deformable_conv(const torch::Tensor& input, const torch::Tensor& given_offsets,
                              const torch::Tensor& weight, std::int64_t stride,
                              std::int64_t dilation) {
  const torch::Tensor x = input.to(torch::kFloat);  // positions need more than half precision
  const torch::Tensor offsets = given_offsets.to(torch::kFloat);
  const std::int64_t side = weight.size(2);
  const torch::Tensor rows = origins(offsets.size(2), stride, dilation, offsets).view({1, -1, 1});
  const torch::Tensor columns =
      origins(offsets.size(3), stride, dilation, offsets).view({1, 1, -1});
  std::vector<torch::Tensor> taps;
  for (std::int64_t k = 0; k < side * side; ++k) {
    const torch::Tensor row = rows + dilation * (k / side) + offsets.select(1, 2 * k);
    const torch::Tensor column = columns + dilation * (k % side) + offsets.select(1, 2 * k + 1);
    taps.push_back(sample(x, column, row));
  }
  const torch::Tensor columns_of_taps = torch::stack(taps, 2).flatten(1, 2);  // (B, C k k, oH, oW)
  return torch::conv2d(columns_of_taps, weight.reshape({weight.size(0), -1, 1, 1}));
}

}  // namespace mms::network
