#include "mms/localization/features/feature_exclusion.hpp"

#include <gtest/gtest.h>

#include "mms/geometry/camera.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

TEST(FeatureExclusion, RemovesFeaturesOnExcludedPixels) {
  const CameraIntrinsics intrinsics = testing::box_camera();
  const CameraModel camera(intrinsics);
  const auto at = [&](double x, double y) {
    return Eigen::Vector3f((2.0 * camera.ray({x, y})).cast<float>());
  };
  FeatureCloud features;
  features.edges = {{at(40, 40), 0.0F}, {at(10, 10), 0.0F}};
  features.planes = {{at(10, 40), {}, 0.0F}, {at(41, 40.4), {}, 0.0F}, {-at(40, 40), {}, 0.0F}};
  for (const int divisor : {1, 2}) {
    const CameraIntrinsics level = downscaled(intrinsics, divisor);
    features.intensity.push_back({level, Image<IntensitySample>(level.width, level.height),
                                  Image<float>(level.width, level.height, 2.0F)});
  }
  Image<std::uint8_t> pixels(intrinsics.width, intrinsics.height);
  pixels(40, 40) = pixels(41, 40) = 1;

  LabeledCloud cloud;
  cloud.width = intrinsics.width;
  cloud.height = intrinsics.height;
  cloud.camera = intrinsics;
  exclude(pixels, cloud, features);

  ASSERT_EQ(features.edges.size(), 1U);
  EXPECT_EQ(features.edges[0].point, at(10, 10));
  ASSERT_EQ(features.planes.size(), 2U) << "a point behind the camera has no pixel";
  EXPECT_EQ(features.planes[0].point, at(10, 40));
  EXPECT_EQ(features.intensity[0].depth(40, 40), 0.0F);
  EXPECT_EQ(features.intensity[0].depth(42, 41), 0.0F) << "its gradient includes an excluded pixel";
  EXPECT_EQ(features.intensity[0].depth(43, 40), 2.0F);
  EXPECT_EQ(features.intensity[1].depth(20, 20), 0.0F);
  EXPECT_EQ(features.intensity[1].depth(22, 20), 2.0F);
}

TEST(FeatureExclusion, RemovesFeaturesOfExcludedScanPoints) {
  FeatureCloud features;
  features.edges = {{{1, 0, 0}, 0.0F, 0.0F, 2}, {{2, 0, 0}, 0.0F, 0.0F, 0}, {{3, 0, 0}, 0.0F}};
  features.planes = {{{4, 0, 0}, {}, 0.0F, 0.0F, 1}, {{5, 0, 0}, {}, 0.0F, 0.0F, 0}};

  Image<std::uint8_t> points(3, 1);
  points(1, 0) = points(2, 0) = 1;
  LabeledCloud scan;
  scan.width = 3;
  scan.height = 1;
  exclude(points, scan, features);

  ASSERT_EQ(features.edges.size(), 2U);
  EXPECT_EQ(features.edges[0].point.x(), 2.0F);
  EXPECT_EQ(features.edges[1].point.x(), 3.0F) << "a feature without a point index stays";
  ASSERT_EQ(features.planes.size(), 1U);
  EXPECT_EQ(features.planes[0].point.x(), 5.0F);
}

}  // namespace
}  // namespace mms
