#include "mms/segmentation/network/solo_network.hpp"

#include <torch/nn/init.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/weights/tensor_shapes.hpp"
#include "mms/segmentation/weights/weight_transfer.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/network/torch_test.hpp"

namespace mms::network {
namespace {

using testing::expect_close;
using testing::expect_in;
using testing::message_of;

/// A network small enough for tests.
NetworkConfig small_config(NetworkVariant variant) {
  return NetworkConfig::preset(NetworkSize::kNano, variant);
}

/// Sets the statistics of batch norms to values as after a training.
void randomise_norms(torch::nn::Module& module) {
  const torch::NoGradGuard no_grad;
  for (auto& [name, tensor] : named_tensors(module)) {
    if (name.ends_with("running_mean")) tensor.normal_(0.0, 0.2);
    if (name.ends_with("running_var")) tensor.uniform_(0.5, 2.0);
  }
}

class EachVariant : public ::testing::TestWithParam<NetworkVariant> {};

TEST_P(EachVariant, HasMapsOfSpecifiedShapes) {
  const NetworkConfig config = small_config(GetParam());
  SoloNetwork network(config);
  network->eval();
  const torch::NoGradGuard no_grad;
  const HeadOutput output = network(torch::randn({2, 3, 96, 128}));
  const auto grids = config.head.grids();
  for (std::size_t i = 0; i < grids.size(); ++i) {
    EXPECT_EQ(output.categories[i].sizes(), (std::vector<std::int64_t>{2, 2, grids[i], grids[i]}));
    EXPECT_EQ(output.kernels[i].sizes(), (std::vector<std::int64_t>{2, 64, grids[i], grids[i]}));
  }
  EXPECT_EQ(output.mask_features.sizes(), (std::vector<std::int64_t>{2, 64, 24, 32}));
  EXPECT_GE(output.mask_features.min().item<double>(), 0.0);
}

TEST_P(EachVariant, HasExactlyPublishedTensors) {
  for (const NetworkSize size : {NetworkSize::kNano, NetworkSize::kR18, NetworkSize::kR50}) {
    const NetworkConfig config = NetworkConfig::preset(size, GetParam());
    SoloNetwork network(config);
    TensorShapes shapes;
    for (const auto& [name, tensor] : named_tensors(*network)) shapes[name] = tensor.sizes().vec();
    EXPECT_EQ(shapes, expected_tensors(config));
  }
}

TEST_P(EachVariant, FoldingKeepsOutput) {
  torch::manual_seed(1);
  SoloNetwork network(small_config(GetParam()));
  randomise_norms(*network);
  network->eval();
  const torch::NoGradGuard no_grad;
  const torch::Tensor image = torch::randn({1, 3, 96, 96});
  const HeadOutput expected = network(image);
  network->fold();
  const HeadOutput folded = network(image);
  const double scale = expected.mask_features.abs().max().item<double>();
  expect_close(folded.mask_features / scale, expected.mask_features / scale, 1e-4);
  for (std::size_t i = 0; i < expected.categories.size(); ++i) {
    expect_close(folded.categories[i], expected.categories[i], 1e-4);
    expect_close(folded.kernels[i], expected.kernels[i], 1e-4);
  }
}

TEST_P(EachVariant, AllUnfrozenWeightsHaveGradients) {
  torch::manual_seed(2);
  SoloNetwork network(small_config(GetParam()));
  for (Backbone& backbone : network->backbones()) backbone->freeze(1);
  {
    const torch::NoGradGuard no_grad;  // weights that start at 0 would hide others' gradients
    for (torch::Tensor& p : network->parameters()) {
      if (p.abs().max().item<double>() == 0.0) p.normal_(0.0, 0.05);
    }
  }
  const HeadOutput output = network(torch::randn({2, 3, 96, 96}));
  torch::Tensor loss = output.mask_features.square().sum();
  for (const torch::Tensor& map : output.kernels) loss = loss + map.square().sum();
  for (const torch::Tensor& map : output.categories) loss = loss + map.square().sum();
  loss.backward();
  for (const auto& item : network->named_parameters()) {
    if (!item.value().requires_grad()) continue;
    ASSERT_TRUE(item.value().grad().defined()) << item.key();
    EXPECT_GT(item.value().grad().abs().sum().item<double>(), 0.0) << item.key();
  }
}

TEST_P(EachVariant, WeightsRoundTrip) {
  torch::manual_seed(3);
  SoloNetwork network(small_config(GetParam()));
  SoloNetwork other(small_config(GetParam()));
  const Weights weights = to_weights(*network);
  load_weights(*other, weights, "weights");
  EXPECT_EQ(to_weights(*other), weights);
}

TEST_P(EachVariant, StartsEqualToPlainNetwork) {
  torch::manual_seed(4);
  SoloNetwork plain(small_config(NetworkVariant::kSolov2));
  randomise_norms(*plain);
  const NetworkConfig config = small_config(GetParam());
  SoloNetwork grown(config);
  load_partial_weights(*grown, grown_to(config, to_weights(*plain)), "plain");
  plain->eval();
  grown->eval();
  const torch::NoGradGuard no_grad;
  const torch::Tensor image = torch::randn({1, 3, 96, 96});
  const HeadOutput expected = plain(image);
  const HeadOutput output = grown(image);
  expect_close(output.mask_features, expected.mask_features, 1e-4);
  for (std::size_t i = 0; i < expected.categories.size(); ++i) {
    expect_close(output.categories[i], expected.categories[i], 1e-4);
    expect_close(output.kernels[i], expected.kernels[i], 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, EachVariant,
                         ::testing::Values(NetworkVariant::kSolov2, NetworkVariant::kRfp,
                                           NetworkVariant::kSac, NetworkVariant::kDetectors));

TEST(SoloNetwork, CoordinatesSpanCornerToCorner) {
  const torch::Tensor c = coordinate_channels(torch::zeros({2, 5, 3, 4}));
  EXPECT_EQ(c.sizes(), (std::vector<std::int64_t>{2, 2, 3, 4}));
  EXPECT_EQ(c[1][0][2][0].item<float>(), -1.0F);
  EXPECT_EQ(c[1][0][0][3].item<float>(), 1.0F);
  EXPECT_EQ(c[0][1][0][2].item<float>(), -1.0F);
  EXPECT_EQ(c[0][1][1][2].item<float>(), 0.0F);
  EXPECT_EQ(c[0][1][2][2].item<float>(), 1.0F);
}

TEST(SoloNetwork, FrozenStagesKeepWeightsAndStatistics) {
  SoloNetwork network(small_config(NetworkVariant::kSolov2));
  Backbone backbone = network->backbones().front();
  backbone->freeze(2);
  backbone->keep_statistics(2);
  network->train();
  const Weights before = to_weights(*network);
  network(torch::randn({2, 3, 96, 96}));
  const Weights after = to_weights(*network);
  for (const auto& [name, tensor] : before.tensors) {
    const bool kept = !name.starts_with("backbone.layer3") &&
                      !name.starts_with("backbone.layer4") && name.starts_with("backbone.");
    if (kept) {
      EXPECT_EQ(tensor, after.tensors.at(name)) << name;
    }
  }
  EXPECT_NE(before.tensors.at("backbone.layer3.0.bn1.running_mean"),
            after.tensors.at("backbone.layer3.0.bn1.running_mean"));
  for (const auto& item : backbone->named_parameters()) {
    const bool frozen = !item.key().starts_with("layer3") && !item.key().starts_with("layer4");
    EXPECT_NE(item.value().requires_grad(), frozen) << item.key();
  }
}

TEST(SoloNetwork, RejectsWeightsOfOtherArchitecture) {
  SoloNetwork network(small_config(NetworkVariant::kSolov2));
  const Weights valid = to_weights(*network);
  Weights missing = valid;
  missing.tensors.erase("neck.fpn_convs.0.conv.bias");
  expect_in("file: misses the tensor neck.fpn_convs.0.conv.bias",
            message_of<DataError>([&] { load_weights(*network, missing, "file"); }));
  Weights extra = valid;
  extra.tensors["neck.rfp_weight.bias"] = {{1}, {0.0F}};
  expect_in("has the tensor neck.rfp_weight.bias, which its network does not have",
            message_of<DataError>([&] { load_weights(*network, extra, "file"); }));
  Weights other = valid;
  other.tensors["mask_head.conv_cls.bias"] = {{80}, std::vector<float>(80)};
  expect_in("tensor mask_head.conv_cls.bias is (80), the network has (2)",
            message_of<DataError>([&] { load_weights(*network, other, "file"); }));
  EXPECT_EQ(to_weights(*network), valid);
}

}  // namespace
}  // namespace mms::network
