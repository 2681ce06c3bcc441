#include "mms/segmentation/engine/network_engine.hpp"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <filesystem>
#include <string>

#include "mms/io/image/image_io.hpp"
#include "mms/io/weights/safetensors.hpp"
#include "mms/segmentation/network/inference.hpp"
#include "mms/segmentation/network/solo_network.hpp"
#include "mms/segmentation/weights/model.hpp"
#include "mms/segmentation/weights/weight_transfer.hpp"

namespace mms::network {
namespace {

namespace fs = std::filesystem;

/// Sets all tensors that start at zero or one to values as after a training.
void randomise(torch::nn::Module& module) {
  const torch::NoGradGuard no_grad;
  for (auto& [name, tensor] : named_tensors(module)) {
    if (name.ends_with("running_mean")) tensor.normal_(0.0, 0.2);
    if (name.ends_with("running_var")) tensor.uniform_(0.5, 2.0);
    const bool zero = tensor.abs().max().item<double>() == 0.0;
    if (zero && !name.ends_with("running_mean")) tensor.normal_(0.0, 0.003);
  }
}

PreparedImage noise(int height, int width) {
  const torch::Tensor values = torch::randn({3 * height * width});
  const float* data = values.data_ptr<float>();
  return {.planes = {data, data + values.numel()},
          .width = width,
          .height = height,
          .valid_width = width,
          .valid_height = height,
          .image_width = width,
          .image_height = height};
}

torch::Tensor as_tensor(const ChannelsLastMap& map, int height, int width, std::int64_t channels) {
  return torch::from_blob(const_cast<float*>(map.data), {height, width, channels},
                          {std::int64_t{width} * map.pitch, map.pitch, 1}, torch::kFloat)
      .permute({2, 0, 1})
      .unsqueeze(0);
}

/// Largest difference relative to the largest value.
double difference(const torch::Tensor& a, const torch::Tensor& b) {
  EXPECT_EQ(a.sizes(), b.sizes());
  return ((a - b).abs().max() / b.abs().max()).item<double>();
}

/// Logits of all masks of a level's kernels and the mask features: (cells, height * width).
torch::Tensor mask_logits(const torch::Tensor& kernels, const torch::Tensor& features) {
  return torch::mm(kernels[0].narrow(0, 0, features.size(1)).flatten(1).t(),
                   features[0].flatten(1));
}

/// Compares the outputs of the engine and libtorch for an image, including the mask logits.
void expect_equal_maps(const NetworkConfig& config, engine::NetworkEngine& engine,
                       SoloNetwork& network, PreparedImage image) {
  const HeadOutput expected = network(
      torch::from_blob(image.planes.data(), {1, 3, image.height, image.width}, torch::kFloat));
  ASSERT_TRUE(expected.mask_features.isfinite().all().item<bool>());
  const HeadMaps maps = engine.run(image);
  const torch::Tensor features =
      as_tensor(maps.mask_features, image.height / 4, image.width / 4, config.head.kernel_channels);
  EXPECT_LT(difference(features, expected.mask_features), 1e-4);
  const auto grids = config.head.grids();
  for (std::size_t level = 0; level < grids.size(); ++level) {
    const int side = grids[level];
    EXPECT_LT(difference(as_tensor(maps.categories[level], side, side, config.classes),
                         expected.categories[level]),
              1e-4);
    const torch::Tensor kernels =
        as_tensor(maps.kernels[level], side, side, config.head.kernel_length());
    EXPECT_LT(difference(kernels, expected.kernels[level]), 1e-4);
    EXPECT_LT(difference(mask_logits(kernels, features),
                         mask_logits(expected.kernels[level], expected.mask_features)),
              1e-4);
  }
}

void expect_equal_on_noise(const NetworkConfig& config, int height, int width) {
  torch::manual_seed(1);
  SoloNetwork network(config);
  randomise(*network);
  network->eval();
  engine::NetworkEngine engine({config, {"person", "agv"}, to_weights(*network)}, "test", {});
  const torch::NoGradGuard no_grad;
  for (int i = 0; i < 2; ++i) expect_equal_maps(config, engine, network, noise(height, width));
}

TEST(NetworkEngine, EqualsLibtorchWithWindow) {
  NetworkConfig config;
  config.head.window = true;
  expect_equal_on_noise(config, 96, 128);
}

TEST(NetworkEngine, EqualsLibtorchWithStatisticsOfEachLevel) {
  NetworkConfig config;
  config.head.level_norms = true;
  expect_equal_on_noise(config, 96, 128);
  config.head.shared_tower = false;
  expect_equal_on_noise(config, 96, 128);
}

class EngineOfEachVariant : public ::testing::TestWithParam<NetworkVariant> {};

TEST_P(EngineOfEachVariant, EqualsLibtorch) {
  expect_equal_on_noise(NetworkConfig::preset(NetworkSize::kNano, GetParam()), 96, 128);
}

TEST_P(EngineOfEachVariant, EqualsLibtorchWithResNet50AndGroupNorm) {
  NetworkConfig config = NetworkConfig::preset(NetworkSize::kR50, GetParam());
  if (config.backbone.sac == SacMode::kDeformable) config.backbone.sac = SacMode::kPlain;
  config.neck.channels = 64;
  config.head.tower_channels = 64;
  config.head.grid_density = 0.4;
  expect_equal_on_noise(config, 128, 96);
}

/// The shipped weights, with small random values for the additional tensors of a variant.
TEST_P(EngineOfEachVariant, EqualsLibtorchOnTwentyImages) {
  const fs::path pictures = fs::path(MMS_SOURCE_DIR) / "../shared/data/people/images";
  if (!fs::exists(pictures)) GTEST_SKIP() << "no shared data in ../shared/data";
  const fs::path file = fs::path(MMS_SOURCE_DIR) / "weights/nano.safetensors";
  SegmentationModel shipped = unpack_model(read_safetensors(file), file.string());
  const NetworkConfig variant = NetworkConfig::preset(NetworkSize::kNano, GetParam());
  NetworkConfig config = shipped.network;
  config.backbone.sac = variant.backbone.sac;
  config.neck.recursive = variant.neck.recursive;
  torch::manual_seed(1);
  SoloNetwork network(config);
  randomise(*network);
  load_partial_weights(*network, grown_to(config, shipped.weights), file.string());
  network->eval();
  engine::NetworkEngine engine({config, shipped.classes, to_weights(*network)}, "test", {});
  const torch::NoGradGuard no_grad;
  int remaining = 20;
  for (const auto& entry : fs::directory_iterator(pictures)) {
    if (remaining-- == 0) break;
    SCOPED_TRACE(entry.path());
    expect_equal_maps(config, engine, network, prepare_image(read_color(entry.path()), config));
  }
  EXPECT_LE(remaining, 0) << "fewer than 20 pictures in " << pictures;
}

INSTANTIATE_TEST_SUITE_P(AllVariants, EngineOfEachVariant,
                         ::testing::Values(NetworkVariant::kSolov2, NetworkVariant::kRfp,
                                           NetworkVariant::kSac, NetworkVariant::kDetectors));

}  // namespace
}  // namespace mms::network
