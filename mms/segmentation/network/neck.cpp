#include "mms/segmentation/network/neck.hpp"

#include <torch/nn/functional.h>

#include <string>
#include <tuple>

#include "mms/core/error.hpp"
#include "mms/segmentation/network/convolve.hpp"

namespace mms::network {
namespace {

namespace nn = torch::nn;
namespace F = torch::nn::functional;

constexpr std::size_t kLevels = BackboneImpl::kStages;

torch::Tensor enlarged_to(const torch::Tensor& x, const torch::Tensor& like) {
  return F::interpolate(x, F::InterpolateFuncOptions()
                               .size(std::vector<std::int64_t>{like.size(2), like.size(3)})
                               .mode(torch::kNearest));
}

/// `ModuleList` registered under a parent whose one child has another name: aspp.0, aspp.1, ...
nn::ModuleList aspp_branches(std::int64_t channels) {
  const std::int64_t quarter = channels / 4;
  nn::ModuleList branches;
  branches->push_back(biased_conv({.in = channels, .out = quarter, .kernel = 1}));
  branches->push_back(biased_conv({.in = channels, .out = quarter}, 3));
  branches->push_back(biased_conv({.in = channels, .out = quarter}, 6));
  branches->push_back(biased_conv({.in = channels, .out = quarter, .kernel = 1}));
  return branches;
}

}  // namespace

AsppImpl::AsppImpl(std::int64_t channels) {
  branches_ = register_module("aspp", aspp_branches(channels));
}

torch::Tensor AsppImpl::forward(const torch::Tensor& x) {
  std::vector<torch::Tensor> parts;
  for (std::size_t i = 0; i < branches_->size(); ++i) {
    const bool global = i + 1 == branches_->size();
    nn::Conv2d branch(branches_->ptr<nn::Conv2dImpl>(i));
    const torch::Tensor input = global ? torch::adaptive_avg_pool2d(x, {1, 1}) : x;
    const torch::Tensor y = convolve(input, branch).relu_();
    parts.push_back(global ? y.expand({-1, -1, x.size(2), x.size(3)}) : y);
  }
  return torch::cat(parts, 1);
}

NeckImpl::NeckImpl(const NeckConfig& config, const BackboneConfig& backbone,
                   const std::array<std::int64_t, BackboneImpl::kStages>& channels) {
  const std::int64_t width = config.channels;
  for (const std::int64_t in : channels) {
    lateral_->push_back(PlainUnit(ConvShape{.in = in, .out = width, .kernel = 1}));
    output_->push_back(PlainUnit(ConvShape{.in = width, .out = width}));
  }
  register_module("lateral_convs", lateral_);
  register_module("fpn_convs", output_);
  if (!config.recursive) return;
  if (width % 4 != 0) {
    throw ConfigError("network.neck.channels", "is " + std::to_string(width),
                      "a recursive pyramid requires a multiple of 4: its ASPP has four parts");
  }
  second_->push_back(Backbone(backbone, width));
  register_module("rfp_modules", second_);
  aspp_ = register_module("rfp_aspp", Aspp(width));
  fusion_ = register_module("rfp_weight", biased_conv({.in = width, .out = 1, .kernel = 1}));
  zero_init(fusion_);
}

Backbone NeckImpl::second_backbone() {
  if (second_->is_empty()) return nullptr;
  return Backbone(second_->ptr<BackboneImpl>(0));
}

Pyramid NeckImpl::build(const BackboneImpl::Features& features) {
  std::array<torch::Tensor, kLevels> merged;
  for (std::size_t i = kLevels; i-- > 0;) {
    merged[i] = lateral_->ptr<PlainUnitImpl>(i)->forward(features[i]);
    if (i + 1 < kLevels) merged[i] = merged[i] + enlarged_to(merged[i + 1], merged[i]);
  }
  Pyramid pyramid;
  for (std::size_t i = 0; i < kLevels; ++i) {
    pyramid[i] = output_->ptr<PlainUnitImpl>(i)->forward(merged[i]);
  }
  pyramid[kLevels] = torch::max_pool2d(pyramid[kLevels - 1], 1, 2);
  return pyramid;
}

Pyramid NeckImpl::second_step(const torch::Tensor& image, const Pyramid& first) {
  const Pyramid again =
      build(second_backbone()->forward(image, {aspp_(first[1]), aspp_(first[2]), aspp_(first[3])}));
  Pyramid fused;
  for (std::size_t i = 0; i < fused.size(); ++i) {
    const torch::Tensor weight = torch::sigmoid(convolve(again[i], fusion_));
    fused[i] = weight * again[i] + (1 - weight) * first[i];
  }
  return fused;
}

Pyramid NeckImpl::forward(const torch::Tensor& image, const BackboneImpl::Features& features) {
  const Pyramid first = build(features);
  return second_->is_empty() ? first : second_step(image, first);
}

}  // namespace mms::network
