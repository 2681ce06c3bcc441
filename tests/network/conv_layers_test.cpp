#include "mms/segmentation/network/conv_layers.hpp"

#include <torch/nn/init.h>

#include "mms/segmentation/network/deformable_conv.hpp"
#include "tests/network/torch_test.hpp"

namespace mms::network {
namespace {

using testing::expect_close;

/// Bilinear value at a subpixel position; 0 outside.
double bilinear(const torch::Tensor& plane, double y, double x) {
  const auto at = [&](std::int64_t v, std::int64_t u) {
    const bool inside = v >= 0 && u >= 0 && v < plane.size(0) && u < plane.size(1);
    return inside ? plane[v][u].item<double>() : 0.0;
  };
  const auto v = static_cast<std::int64_t>(std::floor(y));
  const auto u = static_cast<std::int64_t>(std::floor(x));
  const double b = y - static_cast<double>(v);
  const double a = x - static_cast<double>(u);
  return (1 - b) * ((1 - a) * at(v, u) + a * at(v, u + 1)) +
         b * ((1 - a) * at(v + 1, u) + a * at(v + 1, u + 1));
}

/// The definition, with a loop for every sum.
torch::Tensor naive_deformable_conv(const torch::Tensor& x, const torch::Tensor& offsets,
                                    const torch::Tensor& weight, int stride, int dilation) {
  torch::Tensor out = torch::zeros({x.size(0), weight.size(0), offsets.size(2), offsets.size(3)});
  for (std::int64_t o = 0; o < out.size(1); ++o) {
    for (std::int64_t row = 0; row < out.size(2); ++row) {
      for (std::int64_t column = 0; column < out.size(3); ++column) {
        double sum = 0.0;
        for (std::int64_t k = 0; k < 9; ++k) {
          const double dy = offsets[0][2 * k][row][column].item<double>();
          const double dx = offsets[0][2 * k + 1][row][column].item<double>();
          const double v = static_cast<double>(row * stride - dilation + (k / 3) * dilation) + dy;
          const double u =
              static_cast<double>(column * stride - dilation + (k % 3) * dilation) + dx;
          for (std::int64_t c = 0; c < x.size(1); ++c) {
            sum += weight[o][c][k / 3][k % 3].item<double>() * bilinear(x[0][c], v, u);
          }
        }
        out[0][o][row][column] = sum;
      }
    }
  }
  return out;
}

class DeformableConv : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(DeformableConv, EqualsDefinition) {
  torch::manual_seed(1);
  const auto [stride, dilation] = GetParam();
  const torch::Tensor x = torch::randn({1, 2, 7, 6});
  const torch::Tensor weight = torch::randn({3, 2, 3, 3});
  const torch::Tensor offsets = 2 * torch::randn({1, 18, (6 / stride) + 1, (5 / stride) + 1});
  expect_close(deformable_conv(x, offsets, weight, stride, dilation),
               naive_deformable_conv(x, offsets, weight, stride, dilation), 1e-4);
}

TEST_P(DeformableConv, IsConvolutionWithoutOffsets) {
  torch::manual_seed(2);
  const auto [stride, dilation] = GetParam();
  const torch::Tensor x = torch::randn({2, 4, 9, 8});
  const torch::Tensor weight = torch::randn({5, 4, 3, 3});
  const torch::Tensor plain = torch::conv2d(x, weight, {}, stride, dilation, dilation);
  const torch::Tensor offsets = torch::zeros({2, 18, plain.size(2), plain.size(3)});
  expect_close(deformable_conv(x, offsets, weight, stride, dilation), plain, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(StridesAndDilations, DeformableConv,
                         ::testing::Values(std::pair(1, 1), std::pair(2, 1), std::pair(1, 3),
                                           std::pair(2, 3)));

TEST(DeformableConv, HasGradientsForAllInputs) {
  torch::manual_seed(3);
  const auto with_gradient = torch::TensorOptions().requires_grad(true);
  const torch::Tensor x = torch::randn({1, 2, 5, 5}, with_gradient);
  const torch::Tensor weight = torch::randn({2, 2, 3, 3}, with_gradient);
  const torch::Tensor offsets = torch::rand({1, 18, 5, 5}, with_gradient);
  deformable_conv(x, offsets, weight, 1, 1).square().sum().backward();
  for (const torch::Tensor& input : {x, weight, offsets}) {
    EXPECT_GT(input.grad().abs().sum().item<double>(), 0.0);
  }
}

TEST(StandardisedWeight, HasGivenMeanAndDeviation) {
  torch::manual_seed(4);
  const torch::Tensor weight = 3 * torch::randn({6, 4, 3, 3}) + 1;
  const torch::Tensor gamma = torch::rand({6, 1, 1, 1}) + 0.5;
  const torch::Tensor beta = torch::randn({6, 1, 1, 1});
  const torch::Tensor flat = standardise_weight(weight, gamma, beta).flatten(1);
  expect_close(flat.mean(1), beta.flatten(), 1e-5);
  expect_close(flat.std(1), gamma.flatten(), 1e-4);  // torch's is the unbiased one
}

TEST(StandardisedWeight, EqualsClosedForm) {
  const torch::Tensor weight = torch::tensor({1.0F, 2.0F, 3.0F, 6.0F}).view({1, 1, 2, 2});
  const torch::Tensor one = torch::ones({1, 1, 1, 1});
  const double deviation = std::sqrt((4.0 + 1.0 + 0.0 + 9.0) / 3.0 + 1e-5);
  const torch::Tensor expected =
      torch::tensor({-2.0, -1.0, 0.0, 3.0}).to(torch::kFloat).view({1, 1, 2, 2}) / deviation;
  expect_close(standardise_weight(weight, one, 0 * one), expected, 1e-6);
}

TEST(BackboneConv, StartsWithGivenWeight) {
  torch::manual_seed(5);
  BackboneConv conv(ConvShape{.in = 3, .out = 8}, true);
  expect_close(conv->effective_weight(), conv->named_parameters()["weight"], 1e-5);
}

TEST(SwitchableConv, StartsAsPlainConvolution) {
  torch::manual_seed(6);
  for (const bool deformable : {false, true}) {
    SwitchableConv sac(ConvShape{.in = 4, .out = 5, .stride = 2}, deformable);
    const torch::Tensor x = torch::randn({2, 4, 10, 12});
    const torch::Tensor plain = torch::conv2d(x, sac->named_parameters()["weight"], {}, 2, 1);
    expect_close(sac(x), plain, 1e-4);
  }
}

/// Sets a parameter of a module.
void set(torch::nn::Module& module, const std::string& name, const torch::Tensor& value) {
  const torch::NoGradGuard no_grad;
  module.named_parameters()[name].copy_(value);
}

TEST(SwitchableConv, MixesTwoDilationsBySwitch) {
  torch::manual_seed(7);
  SwitchableConv sac(ConvShape{.in = 3, .out = 4}, false);
  const torch::Tensor difference = torch::randn({4, 3, 3, 3});
  set(*sac, "weight_diff", difference);
  set(*sac, "switch.bias", torch::full({1}, 0.3));
  const torch::Tensor x = torch::randn({1, 3, 9, 9});
  const torch::Tensor weight = sac->named_parameters()["weight"];
  const torch::Tensor expected = 0.3 * torch::conv2d(x, weight, {}, 1, 1, 1) +
                                 0.7 * torch::conv2d(x, weight + difference, {}, 1, 3, 3);
  expect_close(sac(x), expected, 1e-4);
}

TEST(SwitchableConv, SwitchUsesMeanOfFiveByFivePixels) {
  torch::manual_seed(8);
  SwitchableConv sac(ConvShape{.in = 1, .out = 1}, false);
  set(*sac, "switch.weight", torch::ones({1, 1, 1, 1}));
  set(*sac, "switch.bias", torch::zeros({1}));
  const torch::Tensor x = torch::rand({1, 1, 9, 9});
  const torch::Tensor weight = sac->named_parameters()["weight"];
  const torch::Tensor small = torch::conv2d(x, weight, {}, 1, 1, 1);
  const torch::Tensor large = torch::conv2d(x, weight, {}, 1, 3, 3);
  const double mix = x.slice(2, 2, 7).slice(3, 2, 7).mean().item<double>();
  const torch::Tensor at_center = (mix * small + (1 - mix) * large)[0][0][4][4];
  EXPECT_NEAR(sac(x)[0][0][4][4].item<double>(), at_center.item<double>(), 1e-5);
}

TEST(SwitchableConv, AddsGlobalContextBeforeAndAfter) {
  torch::manual_seed(9);
  SwitchableConv sac(ConvShape{.in = 2, .out = 2}, false);
  const torch::Tensor before = torch::randn({2, 2, 1, 1});
  const torch::Tensor after = torch::randn({2, 2, 1, 1});
  set(*sac, "pre_context.weight", before);
  set(*sac, "post_context.weight", after);
  const torch::Tensor x = torch::randn({1, 2, 8, 8});
  const torch::Tensor shifted = x + torch::conv2d(x.mean({2, 3}, true), before);
  const torch::Tensor y = torch::conv2d(shifted, sac->named_parameters()["weight"], {}, 1, 1);
  expect_close(sac(x), y + torch::conv2d(y.mean({2, 3}, true), after), 1e-4);
}

TEST(SwitchableConv, FoldingKeepsOutput) {
  torch::manual_seed(10);
  SwitchableConv sac(ConvShape{.in = 3, .out = 3}, false);
  set(*sac, "switch.bias", torch::full({1}, 0.4));
  const torch::NoGradGuard no_grad;
  const torch::Tensor x = torch::randn({1, 3, 8, 8});
  const torch::Tensor expected = sac(x);
  sac->fold();
  expect_close(sac(x), expected, 1e-6);
}

}  // namespace
}  // namespace mms::network
