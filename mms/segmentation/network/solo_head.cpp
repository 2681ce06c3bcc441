#include "mms/segmentation/network/solo_head.hpp"

#include <torch/nn/functional.h>
#include <torch/nn/init.h>

#include <cmath>
#include <string>

#include "mms/segmentation/network/convolve.hpp"
#include "mms/segmentation/weights/weight_transfer.hpp"

namespace mms::network {
namespace {

namespace nn = torch::nn;
namespace F = torch::nn::functional;

constexpr double kPriorProbability = 0.01;  // initial probability of an object in a cell
constexpr double kInitialSpread = 0.01;  // standard deviation of the predictions' initial weights

torch::Tensor resized(const torch::Tensor& x, std::int64_t height, std::int64_t width) {
  if (x.size(2) == height && x.size(3) == width) return x;
  return F::interpolate(x, F::InterpolateFuncOptions()
                               .size(std::vector<std::int64_t>{height, width})
                               .mode(torch::kBilinear)
                               .align_corners(false));
}

torch::Tensor doubled(const torch::Tensor& x) {
  return resized(x, 2 * x.size(2), 2 * x.size(3));
}

torch::Tensor with_coordinates(const torch::Tensor& x) {
  return torch::cat({x, coordinate_channels(x)}, 1);
}

/// The levels at strides 8, 8, 16, 32, 32.
Pyramid levels_of(const Pyramid& p) {
  return {resized(p[0], p[1].size(2), p[1].size(3)), p[1], p[2], p[3],
          resized(p[4], p[3].size(2), p[3].size(3))};
}

nn::Conv2d prediction(std::int64_t in, std::int64_t out, double bias) {
  nn::Conv2d conv = biased_conv({.in = in, .out = out});
  nn::init::normal_(conv->weight, 0.0, kInitialSpread);
  nn::init::constant_(conv->bias, bias);
  return conv;
}

/// Wide windows at first: nearly no change of the masks.
nn::Conv2d kernel_prediction(const HeadConfig& config) {
  nn::Conv2d conv = prediction(config.tower_channels, config.kernel_length(), 0.0);
  if (config.window) {
    const torch::NoGradGuard no_grad;
    conv->bias.narrow(0, config.kernel_channels, 2).fill_(kInitialWindowDecay);
  }
  return conv;
}

nn::ModuleList make_tower(const HeadConfig& config, std::int64_t in) {
  nn::ModuleList units;
  for (int i = 0; i < config.tower_depth; ++i) {
    units->push_back(
        HeadUnit(ConvShape{.in = i == 0 ? in : config.tower_channels, .out = config.tower_channels},
                 config.norm, config.level_norms ? HeadConfig::kLevels : 0));
  }
  return units;
}

}  // namespace

torch::Tensor coordinate_channels(const torch::Tensor& like) {
  const std::int64_t batch = like.size(0);
  const std::int64_t height = like.size(2);
  const std::int64_t width = like.size(3);
  const torch::Tensor x = torch::linspace(-1, 1, width, like.options()).view({1, 1, 1, width});
  const torch::Tensor y = torch::linspace(-1, 1, height, like.options()).view({1, 1, height, 1});
  return torch::cat({x.expand({batch, 1, height, width}), y.expand({batch, 1, height, width})}, 1);
}

MaskFeatureHeadImpl::MaskFeatureHeadImpl(const HeadConfig& config, std::int64_t in) {
  constexpr std::int64_t kInputs = 4;
  for (std::int64_t level = 0; level < kInputs; ++level) {
    nn::Sequential units;
    for (std::int64_t i = 0; i < std::max<std::int64_t>(1, level); ++i) {
      const std::int64_t coordinates = level == kInputs - 1 ? 2 : 0;
      const std::int64_t channels = i == 0 ? in + coordinates : config.mask_channels;
      units->push_back(
          "conv" + std::to_string(i),
          HeadUnit(ConvShape{.in = channels, .out = config.mask_channels}, config.norm));
    }
    levels_->push_back(units);
  }
  register_module("convs_all_levels", levels_);
  prediction_ = register_module(
      "conv_pred",
      HeadUnit(ConvShape{.in = config.mask_channels, .out = config.kernel_channels, .kernel = 1},
               config.norm));
}

torch::Tensor MaskFeatureHeadImpl::forward(const Pyramid& pyramid) {
  torch::Tensor sum;
  for (std::size_t level = 0; level < levels_->size(); ++level) {
    const bool last = level + 1 == levels_->size();
    torch::Tensor x = last ? with_coordinates(pyramid[level]) : pyramid[level];
    for (const auto& unit : *levels_->ptr<nn::SequentialImpl>(level)) {
      x = unit.get<HeadUnit>()->forward(x);
      if (level > 0) x = doubled(x);
    }
    sum = sum.defined() ? sum + x : x;
  }
  return prediction_(sum);
}

SoloHeadImpl::SoloHeadImpl(const HeadConfig& config, std::int64_t in, std::int64_t classes)
    : config_(config) {
  kernel_tower_ = register_module("kernel_convs", make_tower(config, in + 2));
  if (!config.shared_tower) {
    category_tower_ = register_module("cls_convs", make_tower(config, in));
  }
  const double prior = -std::log((1.0 - kPriorProbability) / kPriorProbability);
  category_ = register_module("conv_cls", prediction(config.tower_channels, classes, prior));
  kernel_ = register_module("conv_kernel", kernel_prediction(config));
  mask_features_ = register_module("mask_feature_head", MaskFeatureHead(config, in));
}

torch::Tensor SoloHeadImpl::tower(nn::ModuleList& units, torch::Tensor x, std::size_t level) {
  for (std::size_t i = 0; i < units->size(); ++i) {
    x = units->ptr<HeadUnitImpl>(i)->forward(x, static_cast<std::int64_t>(level));
  }
  return x;
}

HeadOutput SoloHeadImpl::forward(const Pyramid& pyramid) {
  HeadOutput output;
  output.mask_features = mask_features_(pyramid);
  const Pyramid levels = levels_of(pyramid);
  const auto grids = config_.grids();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const torch::Tensor cells = resized(with_coordinates(levels[i]), grids[i], grids[i]);
    const torch::Tensor for_kernels = tower(kernel_tower_, cells, i);
    const torch::Tensor for_categories =
        config_.shared_tower ? for_kernels
                             : tower(category_tower_, cells.narrow(1, 0, cells.size(1) - 2), i);
    output.kernels[i] = convolve(for_kernels, kernel_);
    output.categories[i] = convolve(for_categories, category_);
  }
  return output;
}

}  // namespace mms::network
