#include "mms/segmentation/engine/network_engine.hpp"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <string>

#include "mms/segmentation/network/inference.hpp"
#include "mms/segmentation/network/solo_network.hpp"

namespace mms::network {
namespace {

/// Gives all that starts at zero or one values as after a training.
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

void expect_equal_maps(const NetworkConfig& config, int height, int width) {
  torch::manual_seed(1);
  SoloNetwork network(config);
  randomise(*network);
  network->eval();
  engine::NetworkEngine engine({config, {"person", "agv"}, to_weights(*network)}, "test", {});
  const torch::NoGradGuard no_grad;
  for (int i = 0; i < 2; ++i) {
    PreparedImage image = noise(height, width);
    const HeadOutput wanted =
        network(torch::from_blob(image.planes.data(), {1, 3, height, width}, torch::kFloat));
    ASSERT_TRUE(wanted.mask_features.isfinite().all().item<bool>());
    const HeadMaps maps = engine.run(image);
    EXPECT_LT(difference(
                  as_tensor(maps.mask_features, height / 4, width / 4, config.head.kernel_channels),
                  wanted.mask_features),
              1e-4);
    const auto grids = config.head.grids();
    for (std::size_t level = 0; level < grids.size(); ++level) {
      const int side = grids[level];
      EXPECT_LT(difference(as_tensor(maps.categories[level], side, side, config.classes),
                           wanted.categories[level]),
                1e-4);
      EXPECT_LT(difference(as_tensor(maps.kernels[level], side, side, config.head.kernel_channels),
                           wanted.kernels[level]),
                1e-4);
    }
  }
}

class EngineOfEachVariant : public ::testing::TestWithParam<NetworkVariant> {};

TEST_P(EngineOfEachVariant, ComputesWhatLibtorchDoes) {
  expect_equal_maps(NetworkConfig::preset(NetworkSize::kNano, GetParam()), 96, 128);
}

TEST_P(EngineOfEachVariant, WithResNet50AndGroupNormToo) {
  NetworkConfig config = NetworkConfig::preset(NetworkSize::kR50, GetParam());
  if (config.backbone.sac == SacMode::kDeformable) config.backbone.sac = SacMode::kPlain;
  config.neck.channels = 64;
  config.head.tower_channels = 64;
  config.head.grid_density = 0.4;
  expect_equal_maps(config, 128, 96);
}

INSTANTIATE_TEST_SUITE_P(AllVariants, EngineOfEachVariant,
                         ::testing::Values(NetworkVariant::kSolov2, NetworkVariant::kRfp,
                                           NetworkVariant::kSac, NetworkVariant::kDetectors));

}  // namespace
}  // namespace mms::network
