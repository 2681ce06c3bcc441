#include "mms/localization/registration/surface_map.hpp"

#include <gtest/gtest.h>

#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();
const Eigen::Vector3f kFront(0.0F, 0.0F, -1.0F);

TEST(SurfaceMap, MeanIsWeightedByInverseVariance) {
  SurfaceMap map(1.0, 100);
  map.insert({{{0.2F, 0.2F, 0.4F}, kFront, 0.01F}, {{0.6F, 0.6F, 0.9F}, kFront, 0.02F}}, kOrigin);
  const auto surface = map.match({0.5F, 0.5F, 0.5F}, kFront);
  ASSERT_TRUE(surface);
  EXPECT_TRUE(surface->mean.isApprox(Eigen::Vector3f(0.28F, 0.28F, 0.5F), 1e-5F));  // 4 : 1
  EXPECT_TRUE(surface->normal.isApprox(kFront, 1e-6F));
  EXPECT_NEAR(surface->sigma, 1.0F / std::sqrt(1e4F + 2.5e3F), 1e-6F);
}

TEST(SurfaceMap, TransformsPointsAndNormalsToWorld) {
  SurfaceMap map(1.0, 100);
  const Eigen::Isometry3d T = testing::motion(3.0, -2.0, 1.0, 0.0, M_PI / 2.0, 0.0);
  map.insert({{{0.1F, 0.2F, 2.0F}, kFront, 0.01F}}, T);
  const Eigen::Vector3f expected = (T * Eigen::Vector3d(0.1, 0.2, 2.0)).cast<float>();
  const auto surface = map.match(expected, {-1.0F, 0.0F, 0.0F});
  ASSERT_TRUE(surface);
  EXPECT_TRUE(surface->mean.isApprox(expected, 1e-5F));
  EXPECT_TRUE(surface->normal.isApprox(Eigen::Vector3f(-1.0F, 0.0F, 0.0F), 1e-5F));
}

TEST(SurfaceMap, MatchesNearestMeanWithSimilarNormal) {
  SurfaceMap map(1.0, 100);
  map.insert({{{0.5F, 0.5F, 0.9F}, kFront, 0.01F},
              {{0.5F, 0.5F, 1.6F}, kFront, 0.01F},
              {{0.5F, 1.1F, 0.9F}, {0.0F, -1.0F, 0.0F}, 0.01F}},
             kOrigin);
  EXPECT_FLOAT_EQ(map.match({0.5F, 0.5F, 1.1F}, kFront)->mean.z(), 0.9F);
  EXPECT_FLOAT_EQ(map.match({0.5F, 0.5F, 1.4F}, kFront)->mean.z(), 1.6F);
  EXPECT_FLOAT_EQ(map.match({0.5F, 0.5F, 1.1F}, {0.0F, -1.0F, 0.0F})->mean.y(), 1.1F);
  EXPECT_FALSE(map.match({0.5F, 0.5F, 1.1F}, {1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(map.match({0.5F, 0.5F, 4.5F}, kFront));
}

TEST(SurfaceMap, DoesNotAverageCornerIntoOneSurface) {
  SurfaceMap map(1.0, 100);
  map.insert({{{0.5F, 0.5F, 0.9F}, kFront, 0.01F}, {{0.1F, 0.5F, 0.5F}, {1, 0, 0}, 0.01F}},
             kOrigin);
  const auto surface = map.match({0.5F, 0.5F, 0.9F}, kFront);
  ASSERT_TRUE(surface);
  EXPECT_TRUE(surface->normal.isApprox(kFront, 1e-6F));
  EXPECT_FLOAT_EQ(surface->mean.x(), 0.5F);
}

TEST(LocalMaps, KeepSurfacesWhenResized) {
  LocalMaps maps(0.1, 1000);
  FeatureCloud features;
  for (int i = 0; i < 100; ++i) {
    const auto x = 0.1F * static_cast<float>(i % 10);
    const auto y = 0.1F * static_cast<float>(i / 10);
    features.planes.push_back({{x, y, 2.0F}, kFront, 0.01F});
  }
  features.edges.push_back({{0.5F, 0.5F, 1.0F}, 0.01F});
  maps.insert(features, kOrigin, Association::kSurface);
  const LocalMaps coarse = maps.resized(0.5, 1000);
  EXPECT_EQ(coarse.voxel_size(), 0.5F);
  EXPECT_EQ(coarse.edges.size(), 1U);
  EXPECT_LT(coarse.surfaces.size(), 10U);
  const auto surface = coarse.surfaces.match({0.9F, 0.1F, 2.3F}, kFront);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->mean.z(), 2.0F, 1e-5F);
  EXPECT_TRUE(surface->normal.isApprox(kFront, 1e-5F));
}

TEST(LocalMaps, RemoveDistantFeaturesFromAllMaps) {
  for (const Association association : {Association::kPaper, Association::kSurface}) {
    LocalMaps maps(0.2, 100000);
    maps.insert(exact_features(testing::BoxRoom{}, kOrigin), kOrigin, association);
    EXPECT_FALSE(maps.edges.empty());
    EXPECT_EQ(maps.plane_points.empty(), association == Association::kSurface);
    EXPECT_EQ(maps.surfaces.empty(), association == Association::kPaper);
    maps.remove_farther_than({50.0F, 0.0F, 0.0F}, 10.0F);
    EXPECT_TRUE(maps.edges.empty() && maps.plane_points.empty() && maps.surfaces.empty());
  }
}

}  // namespace
}  // namespace mms
