#include "mms/segmentation/network/mixed_precision.hpp"

#include <tuple>
#include <vector>

#include "mms/segmentation/network/solo_network.hpp"
#include "tests/network/torch_test.hpp"

namespace mms::network {
namespace {

using Variant = std::tuple<NetworkVariant, SacMode>;

class MixedPrecisionOf : public ::testing::TestWithParam<Variant> {
 protected:
  static NetworkConfig config() {
    const auto [variant, sac] = GetParam();
    NetworkConfig config = NetworkConfig::preset(NetworkSize::kNano, variant);
    if (config.backbone.sac != SacMode::kNone) config.backbone.sac = sac;
    return config;
  }

  /// All outputs of the head, concatenated.
  static torch::Tensor flat(const HeadOutput& output) {
    std::vector<torch::Tensor> parts = {output.mask_features.flatten().to(torch::kFloat)};
    for (const torch::Tensor& map : output.categories) {
      parts.push_back(map.flatten().to(torch::kFloat));
    }
    for (const torch::Tensor& map : output.kernels) {
      parts.push_back(map.flatten().to(torch::kFloat));
    }
    return torch::cat(parts);
  }
};

TEST_P(MixedPrecisionOf, IsCloseToFloatAndTrains) {
  torch::manual_seed(4);
  SoloNetwork network(config());
  const torch::Tensor image = torch::randn({1, 3, 96, 128});
  const torch::Tensor exact = flat(network(image)).detach();
  HeadOutput output;
  {
    const MixedPrecision precision(true, torch::kCPU);
    if (!precision.on()) GTEST_SKIP() << "this CPU does not compute in bfloat16";
    output = network(image);
  }
  const torch::Tensor approximate = flat(output);
  const double error = (approximate.detach() - exact).norm().item<double>();
  EXPECT_LT(error, 0.1 * exact.norm().item<double>());
  EXPECT_GT(error, 0.0);  // otherwise it was not computed in bfloat16
  approximate.square().mean().backward();
  for (const auto& parameter : network->named_parameters()) {
    const torch::Tensor& gradient = parameter.value().grad();
    if (!gradient.defined()) continue;
    EXPECT_EQ(gradient.scalar_type(), torch::kFloat) << parameter.key();
    EXPECT_TRUE(gradient.isfinite().all().item<bool>()) << parameter.key();
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, MixedPrecisionOf,
                         ::testing::Values(Variant{NetworkVariant::kSolov2, SacMode::kNone},
                                           Variant{NetworkVariant::kRfp, SacMode::kNone},
                                           Variant{NetworkVariant::kSac, SacMode::kPlain},
                                           Variant{NetworkVariant::kDetectors, SacMode::kPlain},
                                           Variant{NetworkVariant::kDetectors,
                                                   SacMode::kDeformable}));

}  // namespace
}  // namespace mms::network
