#include "mms/localization/features/scan_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/localization/odometry.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;
using testing::motion;

/// A hall with the LiDAR's z axis up.
BoxRoom hall() {
  return {.low = {-6.0, -4.0, -1.0}, .high = {8.0, 5.0, 2.5}};
}

FeatureCloud features_of(const LabeledCloud& scan) {
  return FeatureExtractor(FeatureConfig{}).extract(scan);
}

TEST(ScanFeatures, EdgesAreAtCreasesAndPlanesOnFaces) {
  const BoxRoom room = hall();
  const FeatureCloud features =
      features_of(testing::spinning_scan(room, Eigen::Isometry3d::Identity(), 48, 0.0, 1));
  ASSERT_GT(features.planes.size(), 500U);
  ASSERT_GT(features.edges.size(), 20U);
  std::size_t at_crease = 0;
  for (const EdgeFeature& edge : features.edges) {
    at_crease += room.distance_to_crease(edge.point.cast<double>()) < 0.5;
  }
  EXPECT_GT(at_crease, features.edges.size() * 9 / 10);
  for (const PlaneFeature& plane : features.planes) {
    const Eigen::Vector3d p = plane.point.cast<double>();
    EXPECT_LT(room.distance_to_face(p), 0.06);       // three sigma, where creases are rounded
    EXPECT_LT(plane.normal.dot(plane.point), 0.0F);  // towards the sensor
    if (room.distance_to_crease(p) < 0.8) continue;  // the diagonal of a neighborhood
    EXPECT_LT(room.distance_to_face(p), 1e-4);
    const Eigen::Vector3d truth = room.cast(Eigen::Vector3d::Zero(), p).normal;
    EXPECT_GT(truth.dot(plane.normal.cast<double>()), 0.999);
  }
}

TEST(ScanFeatures, UseOnlyStaticPoints) {
  const BoxRoom room = hall();
  LabeledCloud scan = testing::spinning_scan(room, Eigen::Isometry3d::Identity(), 32, 0.0, 1);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.points[i].x() > 0.0F) scan.labels[i] = PointLabel::kDynamic;
    if (scan.points[i].y() > 3.0F) {
      scan.labels[i] = PointLabel::kInvalid;
      scan.points[i].setConstant(NAN);
    }
  }
  const FeatureCloud features = features_of(scan);
  ASSERT_GT(features.planes.size(), 100U);
  for (const PlaneFeature& f : features.planes) {
    EXPECT_LE(f.point.x(), 0.0F);
    EXPECT_LE(f.point.y(), 3.0F);
  }
  for (const EdgeFeature& f : features.edges) {
    EXPECT_LE(f.point.x(), 0.0F);
    EXPECT_LE(f.point.y(), 3.0F);
  }
}

TEST(ScanFeatures, AreNearlyIndependentOfPointOrder) {
  LabeledCloud scan = testing::spinning_scan(hall(), Eigen::Isometry3d::Identity(), 32, 0.01, 1);
  const auto count = features_of(scan).planes.size();
  std::mt19937 random(1);
  std::shuffle(scan.points.begin(), scan.points.end(), random);
  const auto shuffled = features_of(scan).planes.size();
  EXPECT_NEAR(static_cast<double>(shuffled), static_cast<double>(count),
              0.1 * static_cast<double>(count));
}

TEST(ScanOdometry, TracksSensorThroughHall) {
  const BoxRoom room = hall();
  Odometry odometry(OdometryConfig{}, DepthNoise{});
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d step = motion(0.12, 0.02, 0.0, 0.0, 0.0, 0.03);
  for (unsigned i = 0; i < 12; ++i) {
    FeatureCloud features = features_of(testing::spinning_scan(room, truth, 32, 0.01, i));
    features.stamp = Timestamp(1'000'000'000 + i * 100'000'000LL);
    const OdometryEstimate estimate = odometry.estimate(features);
    EXPECT_EQ(estimate.status, i == 0 ? Status::kInitialized : Status::kTracking);
    EXPECT_LT(testing::position_error(estimate.T_world_sensor.isometry(), truth), 0.02) << i;
    EXPECT_LT(testing::angle_error_deg(estimate.T_world_sensor.isometry(), truth), 0.2) << i;
    truth = truth * step;
  }
}

}  // namespace
}  // namespace mms
