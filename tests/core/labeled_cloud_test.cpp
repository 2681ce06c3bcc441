#include "mms/core/labeled_cloud.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(DynamicShare, CountsValidPointsOnly) {
  LabeledCloud cloud;
  for (int i = 0; i < 3; ++i) cloud.labels.push_back(PointLabel::kDynamic);
  for (int i = 0; i < 9; ++i) cloud.labels.push_back(PointLabel::kStatic);
  for (int i = 0; i < 100; ++i) cloud.labels.push_back(PointLabel::kInvalid);
  EXPECT_DOUBLE_EQ(dynamic_share(cloud), 0.25);
}

TEST(DynamicShare, IsZeroWithoutValidPoints) {
  LabeledCloud cloud;
  EXPECT_EQ(dynamic_share(cloud), 0.0);
  cloud.labels = std::vector<PointLabel>(5, PointLabel::kInvalid);
  EXPECT_EQ(dynamic_share(cloud), 0.0);
}

TEST(DynamicShare, IsOneWhenAllAreDynamic) {
  LabeledCloud cloud;
  cloud.labels = {PointLabel::kDynamic, PointLabel::kInvalid};
  EXPECT_EQ(dynamic_share(cloud), 1.0);
}

}  // namespace
}  // namespace mms
