#include "mms/segmentation/network/backbone.hpp"

#include <torch/nn/init.h>

#include <string>

#include "mms/segmentation/network/convolve.hpp"

namespace mms::network {
namespace {

namespace nn = torch::nn;

constexpr std::int64_t kStemChannels = 64;

std::array<int, BackboneImpl::kStages> blocks_of(int depth) {
  if (depth == 18) return {2, 2, 2, 2};
  return {3, 4, 6, 3};
}

}  // namespace

torch::Tensor normalised_conv(BackboneConv& conv, BatchNorm& norm, const torch::Tensor& x) {
  const torch::Tensor y = conv(x);
  return conv->folded() ? y : norm(y);
}

ResidualBlockImpl::ResidualBlockImpl(const Shape& shape) : shape_(shape) {
  const bool aws = shape.standardised;
  const std::int64_t planes = shape.planes;
  const ConvShape first = {.in = shape.in,
                           .out = planes,
                           .kernel = shape.bottleneck ? 1 : 3,
                           .stride = shape.bottleneck ? 1 : shape.stride};
  const ConvShape second = {
      .in = planes, .out = planes, .stride = shape.bottleneck ? shape.stride : 1};
  conv1_ = register_module("conv1", BackboneConv(first, aws));
  bn1_ = register_module("bn1", BatchNorm(planes));
  if (shape.sac == SacMode::kNone) {
    conv2_ = register_module("conv2", BackboneConv(second, aws));
  } else {
    switchable2_ =
        register_module("conv2", SwitchableConv(second, shape.sac == SacMode::kDeformable));
  }
  bn2_ = register_module("bn2", BatchNorm(planes));
  if (shape.bottleneck) {
    conv3_ = register_module(
        "conv3", BackboneConv(ConvShape{.in = planes, .out = shape.out(), .kernel = 1}, aws));
    bn3_ = register_module("bn3", BatchNorm(shape.out()));
  }
  if (shape.stride != 1 || shape.in != shape.out()) {
    const ConvShape skip = {
        .in = shape.in, .out = shape.out(), .kernel = 1, .stride = shape.stride};
    skip_conv_ = BackboneConv(skip, aws);
    skip_norm_ = BatchNorm(shape.out());
    register_module("downsample", nn::Sequential(skip_conv_, skip_norm_));
  }
  if (shape.feedback > 0) {
    rfp_conv_ = register_module(
        "rfp_conv", biased_conv({.in = shape.feedback, .out = shape.out(), .kernel = 1}));
    zero_init(rfp_conv_);
  }
}

void ResidualBlockImpl::fold() {
  conv1_->fold(*bn1_);
  if (!conv2_.is_empty()) conv2_->fold(*bn2_);
  if (!switchable2_.is_empty()) switchable2_->fold();
  if (!conv3_.is_empty()) conv3_->fold(*bn3_);
  if (!skip_conv_.is_empty()) skip_conv_->fold(*skip_norm_);
}

torch::Tensor ResidualBlockImpl::skip(const torch::Tensor& x) {
  return skip_conv_.is_empty() ? x : normalised_conv(skip_conv_, skip_norm_, x);
}

torch::Tensor ResidualBlockImpl::residual(const torch::Tensor& x) {
  torch::Tensor y = normalised_conv(conv1_, bn1_, x).relu_();
  y = conv2_.is_empty() ? bn2_(switchable2_(y)) : normalised_conv(conv2_, bn2_, y);
  return conv3_.is_empty() ? y : normalised_conv(conv3_, bn3_, y.relu_());
}

torch::Tensor ResidualBlockImpl::forward(const torch::Tensor& x, const torch::Tensor& feedback) {
  torch::Tensor sum = residual(x) + skip(x);
  if (feedback.defined()) sum = sum + convolve(feedback, rfp_conv_);
  return sum.relu_();
}

BackboneImpl::BackboneImpl(const BackboneConfig& config, std::int64_t feedback) {
  const bool standardised = config.sac != SacMode::kNone;
  conv1_ = register_module(
      "conv1", BackboneConv(ConvShape{.in = 3, .out = kStemChannels, .kernel = 7, .stride = 2},
                            standardised));
  bn1_ = register_module("bn1", BatchNorm(kStemChannels));
  const std::array<std::int64_t, kStages> planes = {64, 128, 256, config.last_planes};
  std::int64_t in = kStemChannels;
  for (int number = 1; number <= kStages; ++number) {
    const auto index = static_cast<std::size_t>(number - 1);
    nn::Sequential blocks;
    for (int block = 0; block < blocks_of(config.depth)[index]; ++block) {
      const bool first = block == 0;
      const ResidualBlockImpl::Shape shape = {.in = in,
                                              .planes = planes[index],
                                              .stride = first && number > 1 ? 2 : 1,
                                              .bottleneck = config.depth >= 50,
                                              .standardised = standardised,
                                              .sac = number > 1 ? config.sac : SacMode::kNone,
                                              .feedback = first && number > 1 ? feedback : 0};
      blocks->push_back(ResidualBlock(shape));
      in = shape.out();
    }
    channels_[index] = in;
    stage(number) = register_module("layer" + std::to_string(number), blocks);
  }
}

BackboneImpl::Features BackboneImpl::forward(
    const torch::Tensor& image, const std::array<torch::Tensor, kStages - 1>& feedback) {
  torch::Tensor x = torch::max_pool2d(normalised_conv(conv1_, bn1_, image).relu_(), 3, 2, 1);
  Features features;
  for (std::size_t i = 0; i < kStages; ++i) {
    bool first = true;
    for (const auto& block : *stages_[i]) {
      const bool fed = first && i > 0;
      x = block.get<ResidualBlock>()->forward(x, fed ? feedback[i - 1] : torch::Tensor());
      first = false;
    }
    features[i] = x;
  }
  return features;
}

void BackboneImpl::fold() {
  conv1_->fold(*bn1_);
  for (nn::Sequential& blocks : stages_) {
    for (const auto& block : *blocks) block.get<ResidualBlock>()->fold();
  }
}

void BackboneImpl::freeze(int stages) {
  if (stages < 1) return;
  for (torch::Tensor& p : conv1_->parameters()) p.requires_grad_(false);
  for (torch::Tensor& p : bn1_->parameters()) p.requires_grad_(false);
  for (int number = 1; number <= stages; ++number) {
    for (torch::Tensor& p : stage(number)->parameters()) p.requires_grad_(false);
  }
}

void BackboneImpl::keep_statistics(int stages) {
  statistics_kept_ = stages;
  train(is_training());
}

void BackboneImpl::train(bool on) {
  Module::train(on);
  if (!on || statistics_kept_ < 1) return;
  bn1_->eval();
  for (int number = 1; number <= statistics_kept_; ++number) stage(number)->eval();
}

}  // namespace mms::network
