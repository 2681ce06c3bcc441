#include "mms/segmentation/weights/weight_transfer.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

NetworkConfig nano(NetworkVariant variant) {
  return NetworkConfig::preset(NetworkSize::kNano, variant);
}

Weights stem() {
  Weights weights;
  weights.tensors["backbone.conv1.weight"] = {{64, 3, 7, 7}, std::vector<float>(9408, 0.25F)};
  return weights;
}

TEST(WeightTransfer, AddsNothingForPlainNetwork) {
  EXPECT_EQ(grown_to(nano(NetworkVariant::kSolov2), stem()), stem());
}

TEST(WeightTransfer, StandardizesBothBackbones) {
  const Weights grown = grown_to(nano(NetworkVariant::kDetectors), stem());
  EXPECT_EQ(grown.tensors.size(), 6U);
  for (const char* backbone : {"backbone.", "neck.rfp_modules.0."}) {
    const std::string conv = backbone + std::string("conv1.weight");
    EXPECT_EQ(grown.tensors.at(conv), stem().tensors.at("backbone.conv1.weight"));
    EXPECT_EQ(grown.tensors.at(conv + "_beta").values, std::vector<float>(64, 0.25F));
  }
}

TEST(WeightTransfer, AddsWindowToKernels) {
  NetworkConfig config = nano(NetworkVariant::kSolov2);
  config.head.window = true;
  Weights given;
  given.tensors["mask_head.conv_kernel.weight"] = {{64, 128, 3, 3},
                                                   std::vector<float>(64 * 128 * 9, 0.25F)};
  given.tensors["mask_head.conv_kernel.bias"] = {{64}, std::vector<float>(64, 0.5F)};
  const Weights grown = grown_to(config, given);
  const WeightTensor& weight = grown.tensors.at("mask_head.conv_kernel.weight");
  EXPECT_EQ(weight.shape, (std::vector<std::int64_t>{68, 128, 3, 3}));
  ASSERT_EQ(weight.values.size(), 68U * 128 * 9);
  EXPECT_EQ(weight.values[64 * 128 * 9 - 1], 0.25F);
  EXPECT_EQ(weight.values.back(), 0.0F);
  const WeightTensor& bias = grown.tensors.at("mask_head.conv_kernel.bias");
  EXPECT_EQ(bias.shape, std::vector<std::int64_t>{68});
  const std::vector<float> window(bias.values.begin() + 64, bias.values.end());
  EXPECT_EQ(window, (std::vector<float>{kInitialWindowDecay, kInitialWindowDecay, 0.0F, 0.0F}));
  EXPECT_EQ(grown_to(config, grown), grown);
  Weights damaged = given;
  damaged.tensors["mask_head.conv_kernel.bias"] = {{3}, std::vector<float>(3)};
  EXPECT_EQ(grown_to(config, damaged), damaged);
  damaged = given;
  damaged.tensors["mask_head.conv_kernel.weight"] = {{}, {1.0F}};
  EXPECT_EQ(grown_to(config, damaged), damaged);
}

TEST(WeightTransfer, GivesEachLevelTheStatisticsOfAll) {
  NetworkConfig config = nano(NetworkVariant::kSolov2);
  config.head.level_norms = true;
  Weights given;
  std::vector<float> means(128, 0.5F);
  means.back() = 2.0F;
  given.tensors["mask_head.kernel_convs.1.bn.running_mean"] = {{128}, means};
  given.tensors["mask_head.mask_feature_head.conv_pred.bn.running_mean"] = {{128}, means};
  const Weights grown = grown_to(config, given);
  const WeightTensor& tower = grown.tensors.at("mask_head.kernel_convs.1.bn.running_mean");
  EXPECT_EQ(tower.shape, (std::vector<std::int64_t>{HeadConfig::kLevels, 128}));
  ASSERT_EQ(tower.values.size(), HeadConfig::kLevels * 128U);
  EXPECT_EQ(tower.values[127], 2.0F);
  EXPECT_EQ(tower.values.back(), 2.0F);
  EXPECT_EQ(tower.values[128], 0.5F);
  EXPECT_EQ(grown.tensors.at("mask_head.mask_feature_head.conv_pred.bn.running_mean"),
            given.tensors.at("mask_head.mask_feature_head.conv_pred.bn.running_mean"));
  EXPECT_EQ(grown_to(config, grown), grown);
}

TEST(WeightTransfer, KeepsGivenTensors) {
  Weights given = stem();
  given.tensors["backbone.conv1.weight_gamma"] = {{64, 1, 1, 1}, std::vector<float>(64, 7.0F)};
  given.tensors["neck.rfp_modules.0.conv1.weight"] = {{64, 3, 7, 7}, std::vector<float>(9408)};
  EXPECT_EQ(grown_to(nano(NetworkVariant::kDetectors), given), given);
}

}  // namespace
}  // namespace mms
