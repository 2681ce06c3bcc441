#pragma once

#include <torch/nn/modules/container/sequential.h>

#include <array>
#include <vector>

#include "mms/segmentation/network/conv_layers.hpp"

namespace mms::network {

/// Convolution and norm, unless the norm is folded.
torch::Tensor normalised_conv(BackboneConv& conv, BatchNorm& norm, const torch::Tensor& x);

/// A residual block; plain (two 3x3) or bottleneck (1x1, 3x3, 1x1). With SAC its second
/// convolution is switchable.
class ResidualBlockImpl : public torch::nn::Module {
 public:
  struct Shape {
    std::int64_t in = 0;      ///< channels
    std::int64_t planes = 0;  ///< of the 3x3 convolutions
    std::int64_t stride = 1;
    bool bottleneck = false;
    bool standardised = false;  ///< standardize the weights of all convolutions
    SacMode sac = SacMode::kNone;
    std::int64_t feedback = 0;  ///< channels of the pyramid's feedback; 0: none

    std::int64_t out() const { return bottleneck ? 4 * planes : planes; }
  };

  explicit ResidualBlockImpl(const Shape& shape);
  /// @param feedback  (B, feedback, H, W) of the output's size; undefined for none
  torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& feedback = {});
  void fold();

 private:
  torch::Tensor skip(const torch::Tensor& x);
  torch::Tensor residual(const torch::Tensor& x);

  Shape shape_;
  BackboneConv conv1_{nullptr};
  BackboneConv conv2_{nullptr};  ///< null if `switchable2_` is used
  SwitchableConv switchable2_{nullptr};
  BackboneConv conv3_{nullptr};  ///< of bottlenecks
  BatchNorm bn1_{nullptr};
  BatchNorm bn2_{nullptr};
  BatchNorm bn3_{nullptr};
  BackboneConv skip_conv_{nullptr};  ///< of `downsample`, if present
  BatchNorm skip_norm_{nullptr};
  torch::nn::Conv2d rfp_conv_{nullptr};
};
TORCH_MODULE(ResidualBlock);

/// ResNet-18, 34 or 50 as in torchvision.
class BackboneImpl : public torch::nn::Module {
 public:
  static constexpr int kStages = 4;
  using Features = std::array<torch::Tensor, kStages>;

  /// @param feedback  channels of the pyramid's feedback to stages 2 to 4; 0: none
  BackboneImpl(const BackboneConfig& config, std::int64_t feedback);

  /// C2 to C5 of (B, 3, H, W): strides 4, 8, 16, 32.
  /// @param feedback  maps for the stages 2 to 4; undefined ones are ignored
  Features forward(const torch::Tensor& image,
                   const std::array<torch::Tensor, kStages - 1>& feedback = {});

  /// Channels of C2 to C5.
  const std::array<std::int64_t, kStages>& channels() const { return channels_; }

  /// Folds batch norms and standardization into the weights, for inference.
  void fold();
  /// Freezes the weights of the stem and the first stages.
  void freeze(int stages);
  /// Freezes the batch norm statistics of the stem and the first stages.
  void keep_statistics(int stages);
  void train(bool on = true) override;

 private:
  torch::nn::Sequential& stage(int number) { return stages_[static_cast<std::size_t>(number - 1)]; }

  BackboneConv conv1_{nullptr};
  BatchNorm bn1_{nullptr};
  std::array<torch::nn::Sequential, kStages> stages_{nullptr, nullptr, nullptr, nullptr};
  std::array<std::int64_t, kStages> channels_{};
  int statistics_kept_ = 0;
};
TORCH_MODULE(Backbone);

}  // namespace mms::network
