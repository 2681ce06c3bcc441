#pragma once

#include <torch/nn/modules/container/modulelist.h>

#include <array>

#include "mms/segmentation/network/neck.hpp"

namespace mms::network {

/// Output of SOLOv2's head for a batch of images.
struct HeadOutput {
  /// Logits of the categories, (B, classes, S, S) for each level's grid of S x S cells.
  std::array<torch::Tensor, HeadConfig::kLevels> categories;
  /// Kernels of the masks, (B, `HeadConfig::kernel_length()`, S, S): E values, and those of the
  /// window.
  std::array<torch::Tensor, HeadConfig::kLevels> kernels;
  /// (B, E, H/4, W/4), not negative: the logits of a mask are the product with its kernel, plus
  /// those of the window.
  torch::Tensor mask_features;
};

/// Mask features from P2 to P5, shared by all masks of an image.
class MaskFeatureHeadImpl : public torch::nn::Module {
 public:
  MaskFeatureHeadImpl(const HeadConfig& config, std::int64_t in);
  torch::Tensor forward(const Pyramid& pyramid);

 private:
  torch::nn::ModuleList levels_;  ///< Sequentials of units
  HeadUnit prediction_{nullptr};
};
TORCH_MODULE(MaskFeatureHead);

/// Kernel, category and mask-feature branches of SOLOv2; weights shared by all levels.
class SoloHeadImpl : public torch::nn::Module {
 public:
  SoloHeadImpl(const HeadConfig& config, std::int64_t in, std::int64_t classes);
  HeadOutput forward(const Pyramid& pyramid);

 private:
  torch::Tensor tower(torch::nn::ModuleList& units, torch::Tensor x, std::size_t level);

  HeadConfig config_;
  torch::nn::ModuleList kernel_tower_;
  torch::nn::ModuleList category_tower_;  ///< empty if the tower is shared
  torch::nn::Conv2d category_{nullptr};
  torch::nn::Conv2d kernel_{nullptr};
  MaskFeatureHead mask_features_{nullptr};
};
TORCH_MODULE(SoloHead);

/// Two channels (B, 2, H, W): x and y from -1 at the first pixel to 1 at the last.
torch::Tensor coordinate_channels(const torch::Tensor& like);

}  // namespace mms::network
