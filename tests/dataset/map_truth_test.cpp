#include "mms/dataset/simulated/map_truth.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/dataset/simulated_frames.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Transform<World, Sensor> pose_at(double x) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = x;
  return Transform<World, Sensor>(pose);
}

TEST(MapTruth, HasExactPointsWithLabels) {
  MapTruth map(0.001, 1);
  const SensorPreset sensor = small_sensor();
  map.add(synthetic_frame(0, sensor), pose_at(5.0));
  const TruthCloud cloud = map.cloud();
  ASSERT_EQ(cloud.points.size(), 32U * 23U);  // without the row without returns
  ASSERT_EQ(cloud.labels.size(), cloud.points.size());
  EXPECT_EQ(cloud.labels.front(), 0);
  EXPECT_EQ(cloud.labels.back(), 1 + kObjectId);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const bool is_static = cloud.labels[i] == 0;
    EXPECT_NEAR(cloud.points[i].z(), is_static ? 2.0 : 1.0, 1e-6);
    EXPECT_EQ(cloud.points[i].x() > 5.0, is_static);
  }
  const double first = 5.0 + 2.0 * (16 - 15.5) / 40.0;  // first pixel of the wall
  EXPECT_NEAR(cloud.points.front().x(), first, 1e-6);
}

TEST(MapTruth, KeepsOnePointPerVoxelAndLabel) {
  MapTruth map;
  map.add({0.01F, 0.01F, 0.01F}, 0);
  map.add({0.02F, 0.02F, 0.02F}, 0);
  map.add({0.02F, 0.02F, 0.02F}, 3);
  map.add({0.05F, 0.01F, 0.01F}, 0);
  const TruthCloud cloud = map.cloud();
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{0, 0, 3}));
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(0.01F, 0.01F, 0.01F));
}

TEST(MapTruth, KeepsMovingObjectsAtAllPositions) {
  MapTruth map(0.04, 2);
  const SensorPreset sensor = small_sensor();
  map.add(synthetic_frame(0, sensor), pose_at(0.0));
  const std::size_t first_count = map.cloud().points.size();
  map.add(synthetic_frame(1, sensor), pose_at(0.0));
  EXPECT_EQ(map.cloud().points.size(), first_count);  // all points are known
  map.add(synthetic_frame(2, sensor), pose_at(10.0));
  EXPECT_EQ(map.cloud().points.size(), 2 * first_count);
}

TEST(MapTruth, IsEmptyWithoutReturns) {
  MapTruth map;
  SimulatedFrame frame = synthetic_frame(0, small_sensor());
  frame.exact.depth = Image<float>(32, 24, std::numeric_limits<float>::infinity());
  map.add(frame, pose_at(0.0));
  map.add(synthetic_frame(0, small_sensor(true)), pose_at(0.0));
  EXPECT_TRUE(map.cloud().points.empty());
}

}  // namespace
}  // namespace mms
