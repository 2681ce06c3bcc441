#pragma once

#include <torch/types.h>

namespace mms::network {

/// Deformable convolution v1 with one offset group and padding = dilation (Dai et al. 2017): every
/// tap samples bilinearly at an offset from its grid position; 0 outside the image.
/// @param x        (B, C, H, W)
/// @param offsets  (B, 2 k k, oH, oW) [px]: dy, dx of each tap in row-major order
/// @param weight   (O, C, k, k) @return (B, O, oH, oW)
torch::Tensor deformable_conv(const torch::Tensor& x, const torch::Tensor& offsets,
                              const torch::Tensor& weight, std::int64_t stride,
                              std::int64_t dilation);

}  // namespace mms::network
