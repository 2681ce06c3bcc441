#include "mms/segmentation/weights/operation_count.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

double gigaflop(const NetworkConfig& config, int width, int height) {
  return 1e-9 * static_cast<double>(network_operations(config, width, height));
}

TEST(OperationCount, NanoStaysBelowTenGigaflop) {
  const auto nano = NetworkConfig::preset(NetworkSize::kNano, NetworkVariant::kSolov2);
  EXPECT_LE(gigaflop(nano, 320, 256), 10.0);
  EXPECT_GE(gigaflop(nano, 320, 256), 5.0);
}

/// SOLOv2-light at 480x640: 94.3 GFLOP with ResNet-18, 125.7 with ResNet-50, counted by hand from
/// the shapes of the layers.
TEST(OperationCount, CountsLightNetworks) {
  NetworkConfig light = NetworkConfig::preset(NetworkSize::kR18, NetworkVariant::kSolov2);
  light.classes = 80;
  EXPECT_NEAR(gigaflop(light, 640, 480), 94.3, 0.5);
  light.backbone = {.depth = 50};
  EXPECT_NEAR(gigaflop(light, 640, 480), 125.7, 0.5);
}

/// RFP adds a second pass of 84.9 GFLOP and 6.1 of its own; SAC adds 21.5 per pass.
TEST(OperationCount, CountsRfpAndSac) {
  NetworkConfig config = NetworkConfig::preset(NetworkSize::kR18, NetworkVariant::kSolov2);
  config.backbone = {.depth = 50};
  const double single_pass = gigaflop(config, 640, 480);
  config.neck.recursive = true;
  EXPECT_NEAR(gigaflop(config, 640, 480) - single_pass, 84.9 + 6.1, 1.0);
  config.neck.recursive = false;
  config.backbone.sac = SacMode::kDeformable;
  EXPECT_NEAR(gigaflop(config, 640, 480) - single_pass, 21.5, 1.0);
}

TEST(OperationCount, CountsParametersOfResnet50) {
  const auto r50 = NetworkConfig::preset(NetworkSize::kR50, NetworkVariant::kSolov2);
  EXPECT_NEAR(1e-6 * static_cast<double>(network_parameters(r50)), 46.0, 1.0);
}

}  // namespace
}  // namespace mms
