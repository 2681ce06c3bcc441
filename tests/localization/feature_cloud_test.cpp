#include "mms/localization/features/feature_cloud.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(MedianRange, UsesEdgesAndPlanes) {
  FeatureCloud features;
  features.edges.push_back({{1.0F, 0.0F, 0.0F}, 0.01F});
  features.edges.push_back({{0.0F, -9.0F, 0.0F}, 0.01F});
  features.planes.push_back({{0.0F, 3.0F, 4.0F}, {0.0F, 0.0F, -1.0F}, 0.01F});
  EXPECT_DOUBLE_EQ(median_range(features), 5.0);
}

TEST(MedianRange, IsZeroWithoutFeatures) {
  EXPECT_EQ(median_range(FeatureCloud{}), 0.0);
}

TEST(AutomaticVoxelSize, ScalesWithRangeWithinBounds) {
  EXPECT_DOUBLE_EQ(automatic_voxel_size(10.0), 0.4);
  EXPECT_EQ(automatic_voxel_size(0.1), 0.05);
  EXPECT_EQ(automatic_voxel_size(500.0), 1.0);
  EXPECT_EQ(automatic_voxel_size(median_range(std::vector<float>{})), 0.05);
}

}  // namespace
}  // namespace mms
