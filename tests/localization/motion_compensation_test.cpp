#include "mms/localization/motion/motion_compensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;

constexpr double kPeriod = 0.1;  // [s]

BoxRoom hall() {
  return {.low = {-6.0, -4.0, -1.0}, .high = {8.0, 5.0, 2.5}};
}

/// A robot's turn at 1.5 m/s and 46 degrees a second.
Vector6d turn() {
  return (Vector6d() << 1.5, 0.2, 0.0, 0.0, 0.0, 0.8).finished();
}

using Ride = Eigen::Isometry3d (*)(double seconds);

/// Starts at rest and has its speed after a second.
Eigen::Isometry3d pose_at(double seconds) {
  const double t = std::max(seconds, 0.0);
  return se3::exp(turn() * (t < 1.0 ? 0.5 * t * t : t - 0.5));
}

Eigen::Isometry3d pose_in_motion_at(double seconds) {
  return se3::exp(turn() * seconds);
}

LabeledCloud scan_at(double seconds, double noise = 0.0, Ride ride = pose_at) {
  return testing::moving_scan(
      hall(), [&](double since) { return ride(seconds + since); }, kPeriod, 32, noise,
      static_cast<unsigned>(seconds / kPeriod));
}

/// Largest distance of a point, seen from `T_world_sensor`, to the hall's faces.
double worst_of(const LabeledCloud& cloud, const Eigen::Isometry3d& T_world_sensor) {
  double worst = 0.0;
  for (const Eigen::Vector3f& point : cloud.points) {
    worst = std::max(worst, hall().distance_to_face(T_world_sensor * point.cast<double>()));
  }
  return worst;
}

/// Worst error of the positions of a turn of 3 s [m]. @param tell  the times of the points
double worst_of_drive(Ride ride, bool tell, double first_offset = 0.0) {
  Odometry odometry({}, {});
  double worst = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double begin = kPeriod * i;
    LabeledCloud scan = scan_at(begin, 0.01, ride);
    for (float& offset : scan.time_offset) offset += static_cast<float>(first_offset);
    if (!tell) scan.time_offset.clear();
    scan.stamp = Timestamp::from_seconds(1.0 + begin - first_offset);
    const auto estimate = odometry.estimate(FeatureExtractor({}).extract(scan));
    EXPECT_EQ(estimate.stamp, scan.stamp);
    const Eigen::Isometry3d truth = ride(-first_offset).inverse() * ride(begin - first_offset);
    worst = std::max(worst, testing::position_error(estimate.T_world_sensor.isometry(), truth));
  }
  return worst;
}

TEST(MotionCompensation, PointsOfAScanAreThoseOfItsStamp) {
  LabeledCloud cloud = scan_at(1.5);
  EXPECT_GT(worst_of(cloud, pose_at(1.5)), 0.15);
  deskew(cloud, turn());
  EXPECT_LT(worst_of(cloud, pose_at(1.5)), 5e-3);
}

TEST(MotionCompensation, FeaturesOfAScanAreThoseOfItsMiddle) {
  FeatureCloud features = FeatureExtractor({}).extract(scan_at(1.5));
  EXPECT_NEAR(to_seconds(features.points_offset), 0.5 * kPeriod, 1e-3);
  deskew(features, turn());
  const Eigen::Isometry3d middle = pose_at(1.5 + 0.5 * kPeriod);
  ASSERT_GT(features.planes.size(), 300U);
  for (const PlaneFeature& plane : features.planes) {
    EXPECT_LT(hall().distance_to_face(middle * plane.point.cast<double>()), 5e-3);
  }
}

TEST(MotionCompensation, CloudsOfOneInstantStayAsTheyAre) {
  LabeledCloud cloud = scan_at(1.5);
  cloud.time_offset.clear();
  const auto before = cloud.points;
  deskew(cloud, turn());
  EXPECT_EQ(cloud.points, before);
}

TEST(MotionCompensation, APoseIsThatOfTheStampWhereverInTheScanItIs) {
  EXPECT_LT(worst_of_drive(pose_at, true), 0.03);
  EXPECT_LT(worst_of_drive(pose_at, true, -kPeriod), 0.03);  // stamped at the last point
  EXPECT_GT(worst_of_drive(pose_at, false), 0.06);
}

TEST(MotionCompensation, ARideMayBeginInMotion) {
  EXPECT_LT(worst_of_drive(pose_in_motion_at, true), 0.03);
  EXPECT_LT(worst_of_drive(pose_in_motion_at, true, -kPeriod), 0.03);
}

}  // namespace
}  // namespace mms
