#include "mms/segmentation/weights/imagenet_backbone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/segmentation/published_checkpoints.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

NetworkConfig r50(NetworkVariant variant) {
  return NetworkConfig::preset(NetworkSize::kR50, variant);
}

NetworkConfig r18(int last_planes) {
  NetworkConfig config = NetworkConfig::preset(NetworkSize::kR18, NetworkVariant::kSolov2);
  config.backbone.last_planes = last_planes;
  return config;
}

/// Two convolutions with their batch norm folded in, and a bias without a convolution.
Weights folded() {
  Weights weights;
  weights.tensors["conv1.weight"] = {{64, 3, 7, 7}, std::vector<float>(9408, 0.25F)};
  weights.tensors["conv1.bias"] = {{64}, std::vector<float>(64, -2.0F)};
  weights.tensors["layer1.0.conv1.weight"] = {{64, 64, 3, 3}, std::vector<float>(36864)};
  for (std::size_t i = 0; i < 36864; ++i) {
    weights.tensors["layer1.0.conv1.weight"].values[i] = std::sin(static_cast<float>(i)) * 0.1F;
  }
  weights.tensors["layer1.0.conv1.bias"] = {{64}, std::vector<float>(64, 3.0F)};
  weights.tensors["layer1.0.conv2.bias"] = {{64}, std::vector<float>(64)};
  return weights;
}

TEST(ImagenetBackbone, TakesAllTorchvisionTensors) {
  const Weights given = torchvision_resnet50();
  const NetworkConfig config = r50(NetworkVariant::kSolov2);
  const ImagenetBackbone result = imagenet_backbone(given, config, "net");
  EXPECT_TRUE(result.left_out.empty());
  std::size_t expected = 0;
  for (const auto& [name, shape] : expected_tensors(config)) {
    if (!name.starts_with("backbone.")) continue;
    ++expected;
    EXPECT_EQ(result.weights.tensors.at(name), given.tensors.at(name.substr(9))) << name;
  }
  EXPECT_EQ(result.weights.tensors.size(), expected);
}

TEST(ImagenetBackbone, FillsBothBackbones) {
  const ImagenetBackbone result =
      imagenet_backbone(torchvision_resnet50(), r50(NetworkVariant::kRfp), "net");
  const auto& tensors = result.weights.tensors;
  EXPECT_EQ(tensors.at("neck.rfp_modules.0.layer4.2.bn3.running_var"),
            tensors.at("backbone.layer4.2.bn3.running_var"));
  EXPECT_FALSE(tensors.contains("neck.rfp_modules.0.layer2.0.rfp_conv.weight"));
  EXPECT_TRUE(result.left_out.empty());
}

TEST(ImagenetBackbone, UnfoldsBatchNorm) {
  const ImagenetBackbone result = imagenet_backbone(folded(), r18(512), "net");
  const auto value = [&](const char* name) {
    const WeightTensor& tensor = result.weights.tensors.at(name);
    EXPECT_EQ(tensor.shape, TensorShape{64});
    return tensor.values[63];
  };
  EXPECT_EQ(value("backbone.bn1.weight"), 1.0F);
  EXPECT_EQ(value("backbone.bn1.bias"), -2.0F);
  EXPECT_EQ(value("backbone.bn1.running_mean"), 0.0F);
  EXPECT_NEAR(value("backbone.bn1.running_var") + 1e-5, 1.0, 1e-7);
  EXPECT_EQ(value("backbone.layer1.0.bn1.bias"), 3.0F);
  EXPECT_EQ(result.weights.tensors.size(), 10U);
}

TEST(ImagenetBackbone, ListsOmittedTensors) {
  const ImagenetBackbone result = imagenet_backbone(folded(), r18(512), "net");
  EXPECT_EQ(result.left_out.size(), 5U * 18);  // 20 convolutions of a ResNet-18, 2 of them given
  for (const char* name : {"backbone.layer1.0.conv2.weight", "backbone.layer1.0.bn2.running_var",
                           "backbone.layer4.0.downsample.0.weight"}) {
    EXPECT_TRUE(std::ranges::count(result.left_out, name)) << name;
  }
}

TEST(ImagenetBackbone, OmitsTensorsOfOtherShape) {
  Weights weights = folded();
  weights.tensors["layer1.0.conv1.bias"] = {{32}, std::vector<float>(32)};
  EXPECT_FALSE(imagenet_backbone(weights, r18(512), "net")
                   .weights.tensors.contains("backbone.layer1.0.conv1.weight"));
  weights.tensors["conv1.weight"].values.pop_back();
  expect_in("net: has no layer of a ResNet-18 for this network",
            message_of<DataError>([&] { imagenet_backbone(weights, r18(512), "net"); }));
}

TEST(ImagenetBackbone, StandardizedWeightsEqualGiven) {
  NetworkConfig config = r18(512);
  config.backbone.sac = SacMode::kPlain;
  const Weights given = folded();
  const auto tensors = imagenet_backbone(given, config, "net").weights.tensors;
  const std::vector<float>& weight = tensors.at("backbone.layer1.0.conv1.weight").values;
  const WeightTensor& gamma = tensors.at("backbone.layer1.0.conv1.weight_gamma");
  const WeightTensor& beta = tensors.at("backbone.layer1.0.conv1.weight_beta");
  EXPECT_EQ(gamma.shape, (TensorShape{64, 1, 1, 1}));
  constexpr std::size_t kCount = 576;           // 64 x 3 x 3
  for (std::size_t out = 0; out < 64; ++out) {  // mmcv's formula
    double mean = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) mean += weight[out * kCount + i] / double{kCount};
    for (std::size_t i = 0; i < kCount; ++i) {
      variance += std::pow(weight[out * kCount + i] - mean, 2) / (kCount - 1.0);
    }
    for (std::size_t i = 0; i < kCount; ++i) {
      const double standardised =
          (weight[out * kCount + i] - mean) / std::sqrt(variance + 1e-5) * gamma.values[out] +
          beta.values[out];
      ASSERT_NEAR(standardised, weight[out * kCount + i], 1e-7);
    }
  }
  EXPECT_NEAR(tensors.at("backbone.conv1.weight_gamma").values[0], std::sqrt(1e-5), 1e-9);
  EXPECT_EQ(tensors.at("backbone.conv1.weight_beta").values[0], 0.25F);
}

/// Reads a valid safetensors file of floats. (`read_safetensors` belongs to io, which this module
/// does not include.)
Weights trusted_floats(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof(length));
  Weights weights;
  const auto header = nlohmann::json::parse(bytes.substr(8, length));
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") continue;
    WeightTensor& tensor = weights.tensors[name];
    tensor.shape = entry["shape"].get<TensorShape>();
    tensor.values.resize(value_count(tensor.shape));
    const char* begin = &bytes.at(8 + length + entry["data_offsets"][0].get<std::size_t>());
    std::memcpy(tensor.values.data(), begin, tensor.values.size() * sizeof(float));
  }
  return weights;
}

TEST(ImagenetBackbone, ReadsSharedFile) {
  const auto path = std::filesystem::path(MMS_SOURCE_DIR) /
                    "../shared/data/weights/resnet18_imagenet_partial.safetensors";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
  const Weights given = trusted_floats(path);
  const ImagenetBackbone wide = imagenet_backbone(given, r18(512), path);
  EXPECT_EQ(wide.left_out.size(), 5U * 4);  // layer4's 3x3 convolutions
  for (const std::string& name : wide.left_out) {
    EXPECT_TRUE(name.starts_with("backbone.layer4.")) << name;
    EXPECT_FALSE(wide.weights.tensors.contains(name)) << name;
  }
  EXPECT_EQ(wide.weights.tensors.at("backbone.layer4.0.downsample.0.weight"),
            given.tensors.at("layer4.0.downsample.0.weight"));
  const ImagenetBackbone narrow = imagenet_backbone(given, r18(256), path);
  EXPECT_EQ(narrow.left_out.size(), 5U * 5);
  EXPECT_EQ(narrow.weights.tensors.size(), 5U * 15);
}

}  // namespace
}  // namespace mms
