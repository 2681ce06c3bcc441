#include "mms/pipeline/pose_comparison.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

FeatureCloud features(std::size_t count) {
  FeatureCloud cloud;
  cloud.planes.resize(count);
  return cloud;
}

/// An infeasible alignment at whose pose some of the features fit.
Odometry::Alignment alignment(std::size_t offered, int inliers) {
  Odometry::Alignment result;
  result.features = features(offered);
  result.registration.emplace();
  result.registration->geometric.planes.inliers = inliers;
  return result;
}

TEST(PoseComparison, AcceptsAnInfeasiblePoseOfNearlyAllFeatures) {
  const Odometry::Alignment few = alignment(255, 237);
  EXPECT_TRUE(explains_more(alignment(1436, 1250), few));
  EXPECT_FALSE(explains_more(alignment(1436, 900), few)) << "too few of them fit";
  EXPECT_FALSE(explains_more(alignment(500, 450), few)) << "hardly more than before";
  Odometry::Alignment strange = alignment(1436, 1250);
  strange.looks_right = false;
  EXPECT_FALSE(explains_more(strange, few)) << "the pixels disagree";
}

TEST(PoseComparison, FeaturesBesideMasksSupportMasksIfTheyFitClearlyBetter) {
  const FeatureCloud beside = features(200);
  EXPECT_TRUE(support_masks(beside, {180, 10.0}, {170, 16.0}));
  EXPECT_FALSE(support_masks(beside, {180, 10.0}, {170, 14.0})) << "hardly better";
  EXPECT_FALSE(support_masks(features(60), {50, 10.0}, {40, 30.0})) << "too few features";
  EXPECT_FALSE(support_masks(features(400), {120, 10.0}, {40, 30.0})) << "most do not fit";
  EXPECT_TRUE(support_masks(beside, {180, 0.0}, {140, 0.0})) << "without images";
}

}  // namespace
}  // namespace mms
