#include "mms/segmentation/weights/checkpoint_import.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/checkpoint_names.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/segmentation/published_checkpoints.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

void drop_counters(Weights& weights) {
  std::erase_if(weights.tensors,
                [](const auto& item) { return item.first.ends_with("num_batches_tracked"); });
}

/// Weights of the smallest network, with its own tensor names.
Weights small_checkpoint() {
  Weights weights;
  for (const auto& [name, shape] : expected_tensors(NetworkConfig())) {
    weights.tensors[name] = {shape, std::vector<float>(value_count(shape), 0.5F)};
  }
  return weights;
}

std::string error_of(const Weights& weights) {
  const std::string message =
      message_of<DataError>([&] { import_checkpoint(weights, "net.safetensors"); });
  EXPECT_TRUE(message.starts_with("net.safetensors: ")) << message;
  return message;
}

TEST(CheckpointImport, ImportsMmdetectionUnchanged) {
  Weights published = published_checkpoint(Naming{}, kFullHead);
  published.metadata["format"] = "pt";
  EXPECT_EQ(published.tensors.at("backbone.layer4.0.downsample.0.weight").shape,
            (TensorShape{2048, 1024, 1, 1}));
  const ImportedNetwork imported = import_checkpoint(published, "net");
  drop_counters(published);
  EXPECT_EQ(imported.weights, published);
  EXPECT_EQ(imported.weights.tensors.size(), expected_tensors(imported.config).size());

  const NetworkConfig& config = imported.config;
  EXPECT_EQ(config.size, NetworkSize::kR50);
  EXPECT_EQ(config.variant, NetworkVariant::kSolov2);
  EXPECT_EQ(config.classes, 80);
  EXPECT_EQ(config.long_side, 1333);
  EXPECT_EQ(config.backbone.depth, 50);
  EXPECT_EQ(config.backbone.last_planes, 512);
  EXPECT_EQ(config.neck.channels, 256);
  EXPECT_EQ(config.head.tower_channels, 512);
  EXPECT_EQ(config.head.tower_depth, 4);
  EXPECT_EQ(config.head.kernel_channels, 256);
  EXPECT_EQ(config.head.mask_channels, 128);
  EXPECT_EQ(config.head.norm, HeadNorm::kGroup);
  EXPECT_FALSE(config.head.shared_tower);
}

TEST(CheckpointImport, ImportsSolo) {
  const Weights solo = published_checkpoint(solo_names(), kLightHead);
  ASSERT_TRUE(solo.tensors.contains("state_dict.module.bbox_head.solo_cate.weight"));
  ASSERT_TRUE(solo.tensors.contains("state_dict.module.mask_feat_head.conv_pred.0.gn.bias"));
  const ImportedNetwork imported = import_checkpoint(solo, "net");
  Weights expected = published_checkpoint(Naming{}, kLightHead);
  drop_counters(expected);
  EXPECT_EQ(imported.weights, expected);
  EXPECT_EQ(imported.config.long_side, 768);
  EXPECT_EQ(imported.config.head.kernel_channels, 128);
}

TEST(CheckpointImport, ImportsAdelaidetWithSwappedColors) {
  Weights adelaidet = published_checkpoint(adelaidet_names(), kLightHead);
  ASSERT_TRUE(adelaidet.tensors.contains("backbone.bottom_up.res5.2.conv3.norm.running_var"));
  ASSERT_TRUE(adelaidet.tensors.contains("ins_head.cate_tower.4.bias"));
  WeightTensor& source = adelaidet.tensors.at("backbone.bottom_up.stem.conv1.weight");
  for (std::size_t i = 0; i < source.values.size(); ++i) source.values[i] = static_cast<float>(i);

  Weights imported = import_checkpoint(adelaidet, "net").weights;
  Weights expected = published_checkpoint(Naming{}, kLightHead);
  drop_counters(expected);
  const WeightTensor converted = imported.tensors.at("backbone.conv1.weight");
  const auto at = [](std::size_t out, std::size_t channel) { return (out * 3 + channel) * 49 + 5; };
  EXPECT_FLOAT_EQ(converted.values[at(7, 0)], source.values[at(7, 2)] * 58.395F);  // red
  EXPECT_FLOAT_EQ(converted.values[at(7, 1)], source.values[at(7, 1)] * 57.12F);
  EXPECT_FLOAT_EQ(converted.values[at(7, 2)], source.values[at(7, 0)] * 57.375F);  // blue
  expect_in("has the stride in the 1x1 convolutions", imported.metadata.at("note"));
  imported.tensors.erase("backbone.conv1.weight");
  expected.tensors.erase("backbone.conv1.weight");
  EXPECT_EQ(imported.tensors, expected.tensors);
}

TEST(CheckpointImport, ImportsDetectors) {
  Weights published = detectors_checkpoint(kLightHead);
  drop_counters(published);
  TensorShapes shapes;
  for (const auto& [name, tensor] : published.tensors) shapes[name] = tensor.shape;
  const ImportedNetwork imported = import_checkpoint(std::move(published), "net");
  EXPECT_EQ(expected_tensors(imported.config), shapes);
  EXPECT_EQ(imported.weights.tensors.size(), shapes.size());
  EXPECT_EQ(imported.config.variant, NetworkVariant::kDetectors);
  EXPECT_EQ(imported.config.backbone.sac, SacMode::kDeformable);
  EXPECT_TRUE(imported.config.neck.recursive);
}

TEST(CheckpointImport, ErrorsNameUnknownTensors) {
  Weights weights = small_checkpoint();
  weights.tensors["module.rpn_head.conv.weight"] = {{1}, {1}};
  expect_in("has 1 tensors that do not fit its network: 'module.rpn_head.conv.weight'",
            error_of(weights));
  for (const char* name : {"fc.bias", "fc.weight", "mask_head.conv_cls.scale"}) {
    weights.tensors[name] = {{1}, {1}};
  }
  expect_in(
      "has 4 tensors that do not fit its network: 'fc.bias', 'fc.weight', "
      "'mask_head.conv_cls.scale', ...",
      error_of(weights));
  weights = small_checkpoint();
  weights.tensors["backbone.layer3.0.conv2.conv_offset.weight"] = {{1}, {1}};
  expect_in("(deformable convolutions are only supported as part of SAC)", error_of(weights));
}

TEST(CheckpointImport, ErrorsNameMissingTensors) {
  Weights weights = small_checkpoint();
  weights.tensors.erase("neck.fpn_convs.1.conv.bias");
  expect_in("lacks 1 tensors of its network, the first one: 'neck.fpn_convs.1.conv.bias' (64)",
            error_of(weights));
  weights.tensors.erase("backbone.layer1.1.conv2.weight");
  expect_in(
      "lacks 2 tensors of its network, the first one: 'backbone.layer1.1.conv2.weight' (64, 64,",
      error_of(weights));
  expect_in("is not a SOLOv2 network", error_of({}));
}

TEST(CheckpointImport, ErrorsNameWrongShapes) {
  Weights weights = small_checkpoint();
  weights.tensors["bbox_head.solo_cate.weight"] = {{2, 128, 1, 1}, std::vector<float>(256)};
  weights.tensors.erase("mask_head.conv_cls.weight");
  expect_in(
      "tensor 'bbox_head.solo_cate.weight' has shape (2, 128, 1, 1), expected "
      "(2, 128, 3, 3)",
      error_of(weights));
  weights = small_checkpoint();
  weights.tensors["mask_head.conv_cls.bias"].values.push_back(0.0F);
  expect_in("tensor 'mask_head.conv_cls.bias' has 3 values, expected by its shape: 2",
            error_of(weights));
}

TEST(CheckpointImport, RejectsDuplicateTensors) {
  Weights weights = small_checkpoint();
  weights.tensors["module.backbone.bn1.bias"] = weights.tensors["backbone.bn1.bias"];
  expect_in("'backbone.bn1.bias' and 'module.backbone.bn1.bias' are the same tensor",
            error_of(weights));
}

TEST(CheckpointNames, KeepsUnknownNames) {
  for (const char* name :
       {"", "ins_head.cate_tower.", "ins_head.cate_tower.x.weight", "ins_head.cate_tower.2.weight",
        "ins_head.cate_tower.-3.weight", "ins_head.kernel_tower.99999999999.weight",
        "bbox_head.fcos_cls.weight"}) {
    EXPECT_EQ(network_name(name), name);
  }
  EXPECT_EQ(network_name("ins_head.kernel_tower.9.weight"), "mask_head.kernel_convs.3.conv.weight");
  EXPECT_EQ(network_name("model.module.state_dict.fc.bias"), "fc.bias");
  EXPECT_EQ(network_name("backbone.bn1.num_batches_tracked"), std::nullopt);
}

}  // namespace
}  // namespace mms
