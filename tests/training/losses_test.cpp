#include "mms/training/run/losses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mms/segmentation/network/solo_network.hpp"
#include "tests/training/samples.hpp"

namespace mms {
namespace {

using testing::box_object;
using testing::sample_of;

TEST(DiceLoss, EqualsClosedForm) {
  const torch::Tensor p = torch::tensor({0.5F, 1.0F, 0.0F, 0.25F}).view({1, 4});
  const torch::Tensor q = torch::tensor({1.0F, 1.0F, 0.0F, 0.0F}).view({1, 4});
  const double expected = 1 - 2 * 1.5 / (0.25 + 1.0 + 0.0625 + 2.0 + 0.002);
  EXPECT_NEAR(dice_loss(p, q).item<double>(), expected, 1e-6);
}

TEST(DiceLoss, IsZeroForPerfectAndOneForDisjointMask) {
  const torch::Tensor a = torch::tensor({1.0F, 1.0F, 0.0F, 0.0F}).view({1, 4});
  EXPECT_NEAR(dice_loss(a, a).item<double>(), 0.0, 1e-3);
  EXPECT_NEAR(dice_loss(a, 1 - a).item<double>(), 1.0, 1e-6);
}

TEST(FocalLoss, EqualsClosedForm) {
  const torch::Tensor logits = torch::tensor({0.0F, 2.0F, -1.0F, 30.0F});
  const torch::Tensor target = torch::tensor({1.0F, 0.0F, 1.0F, 1.0F});
  const torch::Tensor loss = focal_loss(logits, target);
  const auto p = [](double x) { return 1 / (1 + std::exp(-x)); };
  EXPECT_NEAR(loss[0].item<double>(), -0.25 * 0.25 * std::log(0.5), 1e-6);
  EXPECT_NEAR(loss[1].item<double>(), -0.75 * p(2) * p(2) * std::log(1 - p(2)), 1e-5);
  EXPECT_NEAR(loss[2].item<double>(), -0.25 * std::pow(1 - p(-1), 2) * std::log(p(-1)), 1e-5);
  EXPECT_NEAR(loss[3].item<double>(), 0.0, 1e-9);
}

/// Of a scene of one color.
const torch::Tensor kBlack = torch::zeros({1, 3, 128, 128});

/// A head's output with equal values in all cells.
network::HeadOutput constant_output(const HeadConfig& head, float logit) {
  network::HeadOutput output;
  const auto grids = head.grids();
  for (std::size_t i = 0; i < grids.size(); ++i) {
    output.categories[i] = torch::full({1, 2, grids[i], grids[i]}, logit);
    output.kernels[i] = torch::zeros({1, head.kernel_length(), grids[i], grids[i]});
  }
  output.mask_features = torch::zeros({1, head.kernel_channels, 64, 80});
  return output;
}

TEST(SoloLoss, IsBackgroundLossWithoutObjects) {
  const HeadConfig head = NetworkConfig().head;
  const ImageTargets targets = assign_targets(sample_of(320, 256), head);
  const SoloLoss loss = solo_loss(constant_output(head, 0.0F), {targets}, kBlack);
  double cells = 0.0;
  for (const int side : head.grids()) cells += 2.0 * side * side;
  EXPECT_NEAR(loss.category.item<double>(), cells * 0.75 * 0.25 * std::log(2.0), 1e-2);
  EXPECT_EQ(loss.mask.item<double>(), 0.0);
}

TEST(SoloLoss, IgnoresCrowds) {
  const HeadConfig head = NetworkConfig().head;
  ObjectMask crowd = box_object(0, 0, 0, 320, 256);
  crowd.crowd = true;
  const ImageTargets targets = assign_targets(sample_of(320, 256, {crowd}), head);
  EXPECT_EQ(solo_loss(constant_output(head, 3.0F), {targets}, kBlack).category.item<double>(), 0.0);
}

/// The mask of every pair is 0.5 everywhere and its object is a box.
TEST(SoloLoss, MaskLossIsMeanOverPairs) {
  const HeadConfig head = NetworkConfig().head;
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {box_object(1, 80, 40, 160, 160)}), head);
  const SoloLoss loss = solo_loss(constant_output(head, 0.0F), {targets}, kBlack);
  const double area = 40 * 40;
  EXPECT_NEAR(loss.mask.item<double>(), 1 - area / (0.25 * 64 * 80 + area + 0.002), 1e-5);
}

TEST(SoloLoss, LearnsMasksOfLimitedPairs) {
  const HeadConfig head = NetworkConfig().head;
  ImageTargets targets = assign_targets(
      sample_of(320, 256, {box_object(1, 80, 40, 160, 160), box_object(1, 10, 10, 60, 60)}), head);
  const auto mask_loss = [&](int mask_pairs) {
    return solo_loss(constant_output(head, 0.0F), {targets}, kBlack, {}, mask_pairs)
        .mask.item<double>();
  };
  ASSERT_GT(targets.pairs.size(), 1U);
  const double all = mask_loss(200);
  const double first = mask_loss(1);
  targets.pairs.resize(1);
  EXPECT_NEAR(first, mask_loss(200), 1e-9);
  EXPECT_GT(std::abs(first - all), 1e-3);
}

/// All windows are equal, and the features are 0.
TEST(SoloLoss, MasksHaveTheWindowsOfTheirCells) {
  HeadConfig head = NetworkConfig().head;
  head.window = true;
  const ImageTargets targets =
      assign_targets(sample_of(320, 256, {box_object(1, 80, 40, 160, 160)}), head);
  network::HeadOutput output = constant_output(head, 0.0F);
  const std::array<float, 4> terms = {-1.0F, 0.5F, 0.3F, -0.2F};
  for (torch::Tensor& kernels : output.kernels) {
    for (int i = 0; i < 4; ++i) {
      kernels.narrow(1, head.kernel_channels + i, 1).fill_(terms[static_cast<std::size_t>(i)]);
    }
  }
  const auto softplus = [](double v) { return std::log1p(std::exp(v)); };
  double expected = 0.0;
  for (const ImageTargets::Pair& pair : targets.pairs) {
    const int side = head.grids()[static_cast<std::size_t>(pair.level)];
    double common = 0.0;
    double squares = 40 * 40 + 0.002;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 80; ++x) {
        const double u = (x + 0.5) / 80 * side - (pair.cell % side + 0.5);
        const double v = (y + 0.5) / 64 * side - (pair.cell / side + 0.5);
        const double logit =
            terms[2] * u + terms[3] * v - softplus(terms[0]) * u * u - softplus(terms[1]) * v * v;
        const double p = 1 / (1 + std::exp(-logit));
        squares += p * p;
        if (x >= 20 && x < 60 && y >= 10 && y < 50) common += p;
      }
    }
    expected += 1 - 2 * common / squares;
  }
  ASSERT_FALSE(targets.pairs.empty());
  const SoloLoss loss = solo_loss(output, {targets}, kBlack);
  EXPECT_NEAR(loss.mask.item<double>(), expected / static_cast<double>(targets.pairs.size()), 1e-4);
}

/// A rectangle [x0, x1) x [y0, y1) of ones in a plane of 20 x 16.
torch::Tensor rectangle(int x0, int y0, int x1, int y1) {
  torch::Tensor plane = torch::zeros({1, 16, 20});
  plane.index_put_({0, torch::indexing::Slice(y0, y1), torch::indexing::Slice(x0, x1)}, 1.0F);
  return plane;
}

/// An image that is white in the rectangle and black elsewhere.
torch::Tensor picture(const torch::Tensor& rectangle) {
  return rectangle.unsqueeze(1).expand({-1, 3, -1, -1}) * 4.0F;
}

TEST(BoxLoss, IsZeroForTheObjectThatFillsItsBox) {
  const torch::Tensor box = rectangle(4, 3, 12, 13);
  EXPECT_NEAR(box_loss(box, box, picture(box), {0}).item<double>(), 0.0, 1e-2);
}

TEST(BoxLoss, PrefersTheObjectsColorsInsideTheBox) {
  // A cross of one color touches all sides of its box.
  const torch::Tensor cross = torch::maximum(rectangle(6, 3, 10, 13), rectangle(4, 6, 12, 10));
  const torch::Tensor box = rectangle(4, 3, 12, 13);
  const double right = box_loss(cross, box, picture(cross), {0}).item<double>();
  EXPECT_NEAR(right, 0.0, 1e-2);
  EXPECT_GT(box_loss(box, box, picture(cross), {0}).item<double>(), right + 0.3);
}

TEST(BoxLoss, PunishesAMaskThatReachesBeyondTheBox) {
  const torch::Tensor box = rectangle(4, 3, 12, 13);
  const torch::Tensor wide = rectangle(1, 3, 18, 13);
  EXPECT_GT(box_loss(wide, box, picture(box), {0}).item<double>(),
            box_loss(box, box, picture(box), {0}).item<double>() + 0.1);
}

TEST(BoxLoss, TakesTheImageOfEachObject) {
  const torch::Tensor cross = torch::maximum(rectangle(6, 3, 10, 13), rectangle(4, 6, 12, 10));
  const torch::Tensor box = rectangle(4, 3, 12, 13);
  const torch::Tensor images = torch::cat({picture(box), picture(cross)});
  const torch::Tensor losses =
      box_loss(torch::cat({box, box}), torch::cat({box, box}), images, {1, 0});
  EXPECT_FLOAT_EQ(losses[0].item<float>(), box_loss(box, box, picture(cross), {0}).item<float>());
  EXPECT_FLOAT_EQ(losses[1].item<float>(), box_loss(box, box, picture(box), {0}).item<float>());
}

TEST(SoloLoss, DoesNotCountTheBackgroundOfAnIncompleteClass) {
  const HeadConfig head;
  Sample sample = sample_of(128, 128);
  sample.partial = {0};
  ImageTargets targets = assign_targets(sample, head);
  const double one_class =
      solo_loss(constant_output(head, 0.0F), {targets}, kBlack).category.item<double>();
  targets.partial = {};
  const double both =
      solo_loss(constant_output(head, 0.0F), {targets}, kBlack).category.item<double>();
  EXPECT_NEAR(one_class, both / 2, 1e-6 * both);
  targets.partial = {0, 1};
  EXPECT_EQ(solo_loss(constant_output(head, 0.0F), {targets}, kBlack).category.item<double>(), 0.0);
}

}  // namespace
}  // namespace mms
