#include "mms/segmentation/weights/tensor_shapes.hpp"

#include <gtest/gtest.h>

#include "mms/segmentation/weights/backbone_shapes.hpp"

namespace mms {
namespace {

/// Numbers in all tensors whose names end in `end`.
std::size_t count(const TensorShapes& tensors, const std::string& end = "") {
  std::size_t sum = 0;
  for (const auto& [name, shape] : tensors) sum += name.ends_with(end) ? value_count(shape) : 0;
  return sum;
}

TensorShapes backbone(const BackboneConfig& config) {
  LayerShapes layers;
  add_backbone(config, "", 0, layers);
  return layers.shapes();
}

TEST(TensorShapes, BackbonesEqualTorchvision) {
  struct Case {
    int depth;
    std::size_t parameters;  // of torchvision's, without fc
    std::size_t normalised;  // channels of all batch norms
  };
  for (const Case& c :
       {Case{18, 11'176'512, 4'800}, {34, 21'284'672, 8'512}, {50, 23'508'032, 26'560}}) {
    const TensorShapes tensors = backbone({.depth = c.depth});
    const std::size_t statistics = count(tensors, ".running_mean") + count(tensors, ".running_var");
    EXPECT_EQ(count(tensors) - statistics, c.parameters) << c.depth;
    EXPECT_EQ(statistics, 2 * c.normalised) << c.depth;
  }
}

TEST(TensorShapes, NoDownsamplingInBlocksOfEqualSize) {
  const TensorShapes plain = backbone({.depth = 18, .last_planes = 256});
  EXPECT_FALSE(plain.contains("layer1.0.downsample.0.weight"));
  EXPECT_EQ(plain.at("layer2.0.downsample.0.weight"), (TensorShape{128, 64, 1, 1}));
  EXPECT_EQ(plain.at("layer4.0.downsample.0.weight"), (TensorShape{256, 256, 1, 1}));
  EXPECT_FALSE(plain.contains("layer4.1.downsample.0.weight"));
  EXPECT_TRUE(backbone({}).contains("layer1.0.downsample.0.weight"));
}

TEST(TensorShapes, SacIsInSecondConvolutionsOfStages2To4) {
  const TensorShapes plain = backbone({.depth = 18, .sac = SacMode::kPlain});
  EXPECT_EQ(plain.at("layer2.0.conv2.weight_diff"), (TensorShape{128, 128, 3, 3}));
  EXPECT_EQ(plain.at("layer4.1.conv2.switch.weight"), (TensorShape{1, 512, 1, 1}));
  EXPECT_EQ(plain.at("layer2.0.conv1.weight_gamma"), (TensorShape{128, 1, 1, 1}));
  EXPECT_EQ(plain.at("conv1.weight_beta"), (TensorShape{64, 1, 1, 1}));
  EXPECT_FALSE(plain.contains("layer2.0.conv1.weight_diff"));
  EXPECT_FALSE(plain.contains("layer1.0.conv2.weight_diff"));
  EXPECT_FALSE(plain.contains("layer2.0.conv2.offset_s.weight"));
  EXPECT_EQ(backbone({.sac = SacMode::kDeformable}).at("layer3.5.conv2.offset_l.weight"),
            (TensorShape{18, 256, 3, 3}));
}

TEST(TensorShapes, SmallNetworkSharesTower) {
  const TensorShapes tensors = expected_tensors(NetworkConfig());
  EXPECT_EQ(tensors.at("mask_head.kernel_convs.0.conv.weight"), (TensorShape{128, 66, 3, 3}));
  EXPECT_EQ(tensors.at("mask_head.kernel_convs.1.bn.running_var"), (TensorShape{128}));
  EXPECT_EQ(tensors.at("mask_head.conv_cls.bias"), (TensorShape{2}));
  EXPECT_FALSE(tensors.contains("mask_head.cls_convs.0.conv.weight"));
  EXPECT_FALSE(tensors.contains("neck.rfp_weight.weight"));
}

TEST(TensorShapes, RecursionAddsSecondBackbone) {
  const auto config = NetworkConfig::preset(NetworkSize::kR50, NetworkVariant::kRfp);
  const TensorShapes tensors = expected_tensors(config);
  EXPECT_EQ(tensors.at("neck.rfp_modules.0.layer4.0.rfp_conv.weight"),
            (TensorShape{2048, 256, 1, 1}));
  EXPECT_FALSE(tensors.contains("neck.rfp_modules.0.layer1.0.rfp_conv.weight"));
  EXPECT_FALSE(tensors.contains("neck.rfp_modules.0.layer2.1.rfp_conv.weight"));
  EXPECT_FALSE(tensors.contains("backbone.layer2.0.rfp_conv.weight"));
  EXPECT_EQ(tensors.at("neck.rfp_aspp.aspp.2.weight"), (TensorShape{64, 256, 3, 3}));
}

TEST(TensorShapes, FormatsShapes) {
  EXPECT_EQ(shape_text({}), "()");
  EXPECT_EQ(shape_text({64, 3, 7, 7}), "(64, 3, 7, 7)");
}

}  // namespace
}  // namespace mms
