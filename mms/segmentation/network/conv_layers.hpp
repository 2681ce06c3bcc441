#pragma once

#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/normalization.h>

#include <utility>

#include "mms/segmentation/network/batch_norm.hpp"
#include "mms/segmentation/solo/network_config.hpp"

namespace mms::network {

/// Shape of a square convolution.
struct ConvShape {
  std::int64_t in = 0;      ///< channels
  std::int64_t out = 0;     ///< channels
  std::int64_t kernel = 3;  ///< [px]
  std::int64_t stride = 1;  ///< [px]; padding keeps the size at stride 1
};

/// W' = gamma (W - mean) / std + beta per output channel, with the unbiased variance (adaptive
/// weight standardization of DetectoRS, mmcv ConvAWS2d). gamma and beta are (out, 1, 1, 1).
torch::Tensor standardise_weight(const torch::Tensor& weight, const torch::Tensor& gamma,
                                 const torch::Tensor& beta);

/// Convolution of the backbone: no bias; standardized weight if the network has SAC.
class BackboneConvImpl : public torch::nn::Module {
 public:
  BackboneConvImpl(const ConvShape& shape, bool standardised);
  torch::Tensor forward(const torch::Tensor& x);
  /// The weight used in the convolution.
  torch::Tensor effective_weight() const;
  /// Folds the following batch norm into weight and bias, for inference; the norm must be skipped
  /// afterwards.
  void fold(const BatchNormImpl& norm);
  bool folded() const { return bias_.defined(); }

 private:
  ConvShape shape_;
  torch::Tensor weight_;
  torch::Tensor gamma_;  ///< undefined if not standardized
  torch::Tensor beta_;
  torch::Tensor bias_;  ///< of the folded norm; undefined before
};
TORCH_MODULE(BackboneConv);

/// Switchable atrous convolution (DetectoRS): 3x3 convolutions with dilations 1 and 3, mixed per
/// pixel by a switch, between two global contexts.
class SwitchableConvImpl : public torch::nn::Module {
 public:
  SwitchableConvImpl(const ConvShape& shape, bool deformable);
  torch::Tensor forward(const torch::Tensor& input);
  /// Standardizes the weights once, for inference.
  void fold();

 private:
  torch::Tensor small_weight() const;
  torch::Tensor switch_at(const torch::Tensor& x);
  torch::Tensor convolve_at(const torch::Tensor& x, const torch::Tensor& weight,
                            torch::nn::Conv2d& offset, const torch::Tensor& pooled,
                            std::int64_t dilation);

  ConvShape shape_;
  torch::Tensor weight_;
  torch::Tensor gamma_;
  torch::Tensor beta_;
  torch::Tensor difference_;  ///< difference of the dilated weight to the other
  torch::nn::Conv2d switch_{nullptr};
  torch::nn::Conv2d pre_context_{nullptr};
  torch::nn::Conv2d post_context_{nullptr};
  torch::nn::Conv2d offset_small_{nullptr};  ///< null if not deformable
  torch::nn::Conv2d offset_large_{nullptr};
  torch::Tensor folded_;  ///< standardized weight; undefined before `fold`
};
TORCH_MODULE(SwitchableConv);

/// 3x3 or 1x1 convolution without bias, norm, ReLU: the unit of the heads.
class HeadUnitImpl : public torch::nn::Module {
 public:
  /// @param levels  whose batch norms have statistics of their own; 0: one for all
  HeadUnitImpl(const ConvShape& shape, HeadNorm norm, std::int64_t levels = 0);
  /// @param level  of the pyramid
  torch::Tensor forward(const torch::Tensor& x, std::int64_t level = 0);
  /// Folds the batch norm, unless it is one of levels, into the convolution, for inference.
  void fold();

 private:
  torch::nn::Conv2d conv_{nullptr};
  torch::nn::GroupNorm group_norm_{nullptr};
  BatchNorm batch_norm_{nullptr};
};
TORCH_MODULE(HeadUnit);

/// Convolution with bias, registered as child `conv` (names of MMDetection).
class PlainUnitImpl : public torch::nn::Module {
 public:
  explicit PlainUnitImpl(const ConvShape& shape);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::Conv2d conv_{nullptr};
};
TORCH_MODULE(PlainUnit);

/// Weight and bias of a convolution with the following batch norm.
std::pair<torch::Tensor, torch::Tensor> folded_weight(const torch::Tensor& weight,
                                                      const BatchNormImpl& norm);

/// Convolution with bias that keeps the size, for any dilation.
torch::nn::Conv2d biased_conv(const ConvShape& shape, std::int64_t dilation = 1);

/// Sets weight and bias to 0.
void zero_init(torch::nn::Conv2d& conv);

}  // namespace mms::network
