#pragma once

#include <torch/nn/modules/container/modulelist.h>

#include <array>
#include <vector>

#include "mms/segmentation/network/backbone.hpp"

namespace mms::network {

/// P2 to P6: strides 4, 8, 16, 32, 64.
using Pyramid = std::array<torch::Tensor, 5>;

/// Atrous spatial pyramid pooling of DetectoRS: the feedback of the pyramid.
class AsppImpl : public torch::nn::Module {
 public:
  /// @param channels  input and output channels; a multiple of 4
  explicit AsppImpl(std::int64_t channels);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::ModuleList branches_;
};
TORCH_MODULE(Aspp);

/// Feature pyramid on a backbone's features; with `recursive`, a second backbone with the feedback
/// of the first pyramid processes the image again, and both pyramids are fused (RFP, two steps).
class NeckImpl : public torch::nn::Module {
 public:
  NeckImpl(const NeckConfig& config, const BackboneConfig& backbone,
           const std::array<std::int64_t, BackboneImpl::kStages>& channels);

  /// @param image     (B, 3, H, W), input of the second backbone
  /// @param features  of the first backbone
  Pyramid forward(const torch::Tensor& image, const BackboneImpl::Features& features);

  /// The second backbone; null without recursion.
  Backbone second_backbone();

 private:
  Pyramid build(const BackboneImpl::Features& features);
  Pyramid second_step(const torch::Tensor& image, const Pyramid& first);

  torch::nn::ModuleList lateral_;
  torch::nn::ModuleList output_;
  torch::nn::ModuleList second_;  ///< the second backbone, if any
  Aspp aspp_{nullptr};
  torch::nn::Conv2d fusion_{nullptr};
};
TORCH_MODULE(Neck);

}  // namespace mms::network
