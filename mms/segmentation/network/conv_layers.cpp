#include "mms/segmentation/network/conv_layers.hpp"

#include <torch/nn/functional.h>
#include <torch/nn/init.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mms/segmentation/network/convolve.hpp"
#include "mms/segmentation/network/deformable_conv.hpp"

namespace mms::network {
namespace {

namespace nn = torch::nn;

constexpr double kVarianceFloor = 1e-5;
constexpr std::int64_t kLargeDilation = 3;
constexpr std::int64_t kGroups = 32;

torch::Tensor kaiming_weight(const ConvShape& shape) {
  torch::Tensor weight = torch::empty({shape.out, shape.in, shape.kernel, shape.kernel});
  nn::init::kaiming_normal_(weight, 0.0, torch::kFanOut, torch::kReLU);
  return weight;
}

/// Mean and standard deviation of the weights of each output channel: (out, 1, 1, 1) both.
std::pair<torch::Tensor, torch::Tensor> channel_statistics(const torch::Tensor& weight) {
  const auto [variance, mean] =
      torch::var_mean(weight, {1, 2, 3}, /*unbiased=*/true, /*keepdim=*/true);
  return {mean, (variance + kVarianceFloor).sqrt()};
}

/// Mean of the 5x5 pixels around each stride-th one, mirrored at the boundary.
torch::Tensor mean_about(const torch::Tensor& x, std::int64_t stride = 1) {
  return torch::avg_pool2d(torch::reflection_pad2d(x, {2, 2, 2, 2}), 5, stride);
}

torch::Tensor add_context(const torch::Tensor& x, nn::Conv2d& context) {
  return x + convolve(torch::adaptive_avg_pool2d(x, {1, 1}), context);
}

}  // namespace

torch::Tensor standardise_weight(const torch::Tensor& weight, const torch::Tensor& gamma,
                                 const torch::Tensor& beta) {
  const auto [mean, deviation] = channel_statistics(weight);
  const torch::Tensor scale = gamma / deviation;
  return torch::addcmul(beta - mean * scale, weight, scale);
}

std::pair<torch::Tensor, torch::Tensor> folded_weight(const torch::Tensor& weight,
                                                      const BatchNormImpl& norm) {
  const torch::NoGradGuard no_grad;
  const auto [scale, shift] = norm.scale_and_shift();
  return {weight * scale.view({-1, 1, 1, 1}), shift};
}

nn::Conv2d biased_conv(const ConvShape& shape, std::int64_t dilation) {
  return nn::Conv2d(nn::Conv2dOptions(shape.in, shape.out, shape.kernel)
                        .stride(shape.stride)
                        .padding(dilation * (shape.kernel / 2))
                        .dilation(dilation));
}

void zero_init(nn::Conv2d& conv) {
  nn::init::zeros_(conv->weight);
  nn::init::zeros_(conv->bias);
}

BackboneConvImpl::BackboneConvImpl(const ConvShape& shape, bool standardised) : shape_(shape) {
  weight_ = register_parameter("weight", kaiming_weight(shape));
  if (!standardised) return;
  const auto [mean, deviation] = channel_statistics(weight_.detach());
  gamma_ = register_buffer("weight_gamma", deviation.clone());
  beta_ = register_buffer("weight_beta", mean.clone());
}

torch::Tensor BackboneConvImpl::effective_weight() const {
  return gamma_.defined() ? standardise_weight(weight_, gamma_, beta_) : weight_;
}

void BackboneConvImpl::fold(const BatchNormImpl& norm) {
  const auto [weight, bias] = folded_weight(effective_weight(), norm);
  weight_.set_data(weight);
  gamma_ = torch::Tensor();
  bias_ = register_buffer("folded_bias", bias);
}

torch::Tensor BackboneConvImpl::forward(const torch::Tensor& x) {
  return convolve(x, effective_weight(), bias_, shape_.stride);
}

SwitchableConvImpl::SwitchableConvImpl(const ConvShape& shape, bool deformable) : shape_(shape) {
  weight_ = register_parameter("weight", kaiming_weight(shape));
  const auto [mean, deviation] = channel_statistics(weight_.detach());
  gamma_ = register_buffer("weight_gamma", deviation.clone());
  beta_ = register_buffer("weight_beta", mean.clone());
  difference_ = register_parameter("weight_diff", torch::zeros_like(weight_));
  switch_ = register_module(
      "switch", biased_conv({.in = shape.in, .out = 1, .kernel = 1, .stride = shape.stride}));
  nn::init::zeros_(switch_->weight);
  nn::init::ones_(switch_->bias);
  pre_context_ =
      register_module("pre_context", biased_conv({.in = shape.in, .out = shape.in, .kernel = 1}));
  post_context_ = register_module("post_context",
                                  biased_conv({.in = shape.out, .out = shape.out, .kernel = 1}));
  zero_init(pre_context_);
  zero_init(post_context_);
  if (!deformable) return;
  const ConvShape offsets = {.in = shape.in, .out = 18, .stride = shape.stride};
  offset_small_ = register_module("offset_s", biased_conv(offsets));
  offset_large_ = register_module("offset_l", biased_conv(offsets));
  zero_init(offset_small_);
  zero_init(offset_large_);
}

torch::Tensor SwitchableConvImpl::small_weight() const {
  return folded_.defined() ? folded_ : standardise_weight(weight_, gamma_, beta_);
}

void SwitchableConvImpl::fold() {
  const torch::NoGradGuard no_grad;
  folded_ = register_buffer("folded_weight", small_weight());
}

torch::Tensor SwitchableConvImpl::convolve_at(const torch::Tensor& x, const torch::Tensor& weight,
                                              nn::Conv2d& offset, const torch::Tensor& pooled,
                                              std::int64_t dilation) {
  if (offset.is_empty()) return convolve(x, weight, {}, shape_.stride, dilation);
  return deformable_conv(x, convolve(pooled, offset), weight, shape_.stride, dilation);
}

/// The switch of the means is the mean of the switch map, which has one channel.
torch::Tensor SwitchableConvImpl::switch_at(const torch::Tensor& x) {
  const torch::Tensor each = torch::conv2d(x, switch_->weight, switch_->bias);
  return mean_about(each, shape_.stride);
}

torch::Tensor SwitchableConvImpl::forward(const torch::Tensor& input) {
  const torch::Tensor x = add_context(input, pre_context_);
  const bool deformable = !offset_small_.is_empty();
  const torch::Tensor pooled = deformable ? mean_about(x) : torch::Tensor();
  const torch::Tensor mix = deformable ? convolve(pooled, switch_) : switch_at(x);
  const torch::Tensor weight = small_weight();
  const torch::Tensor small = convolve_at(x, weight, offset_small_, pooled, 1);
  const torch::Tensor large =
      convolve_at(x, weight + difference_, offset_large_, pooled, kLargeDilation);
  // In mixed precision the mean over pixels stays in float32, the convolutions do not.
  const torch::Tensor share = mix.to(small.scalar_type());
  return add_context(torch::lerp(large, small, share), post_context_);
}

HeadUnitImpl::HeadUnitImpl(const ConvShape& shape, HeadNorm norm, std::int64_t levels) {
  conv_ = register_module("conv", nn::Conv2d(nn::Conv2dOptions(shape.in, shape.out, shape.kernel)
                                                 .stride(shape.stride)
                                                 .padding(shape.kernel / 2)
                                                 .bias(false)));
  nn::init::kaiming_normal_(conv_->weight, 0.0, torch::kFanOut, torch::kReLU);
  if (norm == HeadNorm::kBatch) {
    batch_norm_ = register_module("bn", BatchNorm(shape.out, levels));
  } else {
    const std::int64_t groups = std::gcd(kGroups, shape.out);
    group_norm_ = register_module("gn", nn::GroupNorm(groups, shape.out));
  }
}

void HeadUnitImpl::fold() {
  if (batch_norm_.is_empty() || batch_norm_->has_levels()) return;
  const auto [weight, bias] = folded_weight(conv_->weight, *batch_norm_);
  conv_->weight.set_data(weight);
  conv_->bias = register_buffer("folded_bias", bias);
  batch_norm_ = nullptr;
}

torch::Tensor HeadUnitImpl::forward(const torch::Tensor& x, std::int64_t level) {
  torch::Tensor y = convolve(x, conv_);
  if (!batch_norm_.is_empty()) y = batch_norm_(y, level);
  if (!group_norm_.is_empty()) y = group_norm_(y);
  return y.relu_();
}

PlainUnitImpl::PlainUnitImpl(const ConvShape& shape) {
  conv_ = register_module("conv", biased_conv(shape));
  nn::init::xavier_uniform_(conv_->weight);
  nn::init::zeros_(conv_->bias);
}

torch::Tensor PlainUnitImpl::forward(const torch::Tensor& x) {
  return convolve(x, conv_);
}

}  // namespace mms::network
