#include "mms/segmentation/weights/config_inference.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;

/// Expects equal values of all fields that follow from shapes.
void expect_same_architecture(const NetworkConfig& actual, const NetworkConfig& expected) {
  EXPECT_EQ(actual.variant, expected.variant);
  EXPECT_EQ(actual.classes, expected.classes);
  EXPECT_EQ(actual.backbone.depth, expected.backbone.depth);
  EXPECT_EQ(actual.backbone.last_planes, expected.backbone.last_planes);
  EXPECT_EQ(actual.backbone.sac, expected.backbone.sac);
  EXPECT_EQ(actual.neck.channels, expected.neck.channels);
  EXPECT_EQ(actual.neck.recursive, expected.neck.recursive);
  EXPECT_EQ(actual.head.tower_channels, expected.head.tower_channels);
  EXPECT_EQ(actual.head.tower_depth, expected.head.tower_depth);
  EXPECT_EQ(actual.head.shared_tower, expected.head.shared_tower);
  EXPECT_EQ(actual.head.kernel_channels, expected.head.kernel_channels);
  EXPECT_EQ(actual.head.mask_channels, expected.head.mask_channels);
  EXPECT_EQ(actual.head.window, expected.head.window);
  EXPECT_EQ(actual.head.norm, expected.head.norm);
  EXPECT_EQ(actual.head.grid_density, 1.0);
}

TEST(ConfigInference, InfersEveryPreset) {
  for (const auto size : {NetworkSize::kNano, NetworkSize::kR18, NetworkSize::kR50}) {
    for (const auto variant : {NetworkVariant::kSolov2, NetworkVariant::kRfp, NetworkVariant::kSac,
                               NetworkVariant::kDetectors}) {
      const NetworkConfig expected = NetworkConfig::preset(size, variant);
      expect_same_architecture(infer_config(expected_tensors(expected), "net"), expected);
    }
  }
}

TEST(ConfigInference, InfersWindow) {
  NetworkConfig expected;
  expected.head.window = true;
  expected.head.kernel_channels = 48;
  expect_same_architecture(infer_config(expected_tensors(expected), "net"), expected);
}

TEST(ConfigInference, InfersImageSizeFromTowers) {
  NetworkConfig config = NetworkConfig::preset(NetworkSize::kR50, NetworkVariant::kSolov2);
  config.backbone.depth = 34;
  const NetworkConfig full = infer_config(expected_tensors(config), "net");
  EXPECT_EQ(full.size, NetworkSize::kR18);
  EXPECT_EQ(full.long_side, 1333);
  EXPECT_EQ(full.short_side, 800);
  EXPECT_EQ(full.head.object_scale, 96);
  config.head.tower_channels = 256;
  config.backbone.depth = 50;
  const NetworkConfig light = infer_config(expected_tensors(config), "net");
  EXPECT_EQ(light.size, NetworkSize::kR50);
  EXPECT_EQ(light.long_side, 768);
  EXPECT_EQ(light.short_side, 448);
  EXPECT_EQ(light.head.object_scale, 56);
}

TEST(ConfigInference, ErrorsExplainUnknownNetworks) {
  const TensorShapes valid = expected_tensors(NetworkConfig());
  const auto error = [&](const auto& change) {
    TensorShapes tensors = valid;
    change(tensors);
    const std::string message = message_of<DataError>([&] { infer_config(tensors, "net"); });
    EXPECT_TRUE(message.starts_with("net: ")) << message;
    return message;
  };
  expect_in(
      "is not a SOLOv2 network: missing tensor 'mask_head.kernel_convs.0.conv.weight' (supported",
      error([](TensorShapes& t) { t.clear(); }));
  expect_in("missing tensor 'mask_head.conv_cls.weight'",
            error([](TensorShapes& t) { t.erase("mask_head.conv_cls.weight"); }));
  expect_in("stages of 2, 2, 23, 2 plain blocks, allowed: ResNet-18 (2, 2, 2, 2 plain)",
            error([](TensorShapes& t) { t["backbone.layer3.22.conv1.weight"] = {}; }));
  expect_in("stages of 2, 2, 2, 2 bottleneck blocks",
            error([](TensorShapes& t) { t["backbone.layer1.0.conv3.weight"] = {}; }));
  expect_in("tensor 'mask_head.conv_cls.weight' has shape (2), a convolution's (out, in, height",
            error([](TensorShapes& t) { t["mask_head.conv_cls.weight"] = {2}; }));
  expect_in("has shape (4294967296, 0, 1, 1)", error([](TensorShapes& t) {
              t["mask_head.conv_cls.weight"] = {1LL << 32, 0, 1, 1};
            }));
  expect_in("a network whose classes is 0, allowed: 1 to 1000", error([](TensorShapes& t) {
              t["mask_head.conv_cls.weight"] = {0, 128, 3, 3};
            }));
  expect_in("a network whose tower_depth is 100, allowed: 1 to 8",
            error([](TensorShapes& t) { t["mask_head.kernel_convs.99.conv.weight"] = {}; }));
}

TEST(ConfigInference, IgnoresInvalidNumbersInNames) {
  TensorShapes tensors = expected_tensors(NetworkConfig());
  for (const char* number : {"-1", "x", "99999999999999999999", "2147483647", ""}) {
    tensors[std::string("backbone.layer1.") + number + ".conv1.weight"] = {};
  }
  EXPECT_EQ(infer_config(tensors, "net").backbone.depth, 18);
}

}  // namespace
}  // namespace mms
