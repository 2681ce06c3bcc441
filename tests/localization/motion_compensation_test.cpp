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

/// Velocity of a robot in a turn: 1.5 m/s and 46 degrees a second.
Vector6d velocity() {
  return (Vector6d() << 1.5, 0.2, 0.0, 0.0, 0.0, 0.8).finished();
}

using PoseOf = Eigen::Isometry3d (*)(double seconds);

/// Starts at rest and reaches its velocity after a second.
Eigen::Isometry3d pose_at(double seconds) {
  const double t = std::max(seconds, 0.0);
  return se3::exp(velocity() * (t < 1.0 ? 0.5 * t * t : t - 0.5));
}

Eigen::Isometry3d pose_in_motion_at(double seconds) {
  return se3::exp(velocity() * seconds);
}

/// Drives ahead for a second, then begins to turn by 75 degrees a second within one scan.
Eigen::Isometry3d pose_in_sudden_turn_at(double seconds) {
  const Vector6d ahead = (Vector6d() << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0).finished();
  const Vector6d turn = (Vector6d() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.3).finished();
  return se3::exp(ahead * std::min(seconds, 1.0)) * se3::exp(turn * std::max(seconds - 1.0, 0.0));
}

LabeledCloud scan_at(double seconds, double noise = 0.0, PoseOf pose_of = pose_at) {
  return testing::moving_scan(
      hall(), [&](double since) { return pose_of(seconds + since); }, kPeriod, 32, noise,
      static_cast<unsigned>(seconds / kPeriod));
}

/// Largest distance of the points to the hall's faces, with the cloud at `T_world_sensor` [m].
double max_face_distance(const LabeledCloud& cloud, const Eigen::Isometry3d& T_world_sensor) {
  double max_error = 0.0;
  for (const Eigen::Vector3f& point : cloud.points) {
    max_error = std::max(max_error, hall().distance_to_face(T_world_sensor * point.cast<double>()));
  }
  return max_error;
}

/// Largest position error in a turn of 3 s [m]. @param with_times  with the times of the points
double max_position_error(PoseOf pose_of, bool with_times, double first_offset = 0.0) {
  Odometry odometry({}, {});
  double max_error = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double begin = kPeriod * i;
    LabeledCloud scan = scan_at(begin, 0.01, pose_of);
    for (float& offset : scan.time_offset) offset += static_cast<float>(first_offset);
    if (!with_times) scan.time_offset.clear();
    scan.stamp = Timestamp::from_seconds(1.0 + begin - first_offset);
    const auto estimate = odometry.estimate(FeatureExtractor({}).extract(scan));
    EXPECT_EQ(estimate.stamp, scan.stamp);
    const Eigen::Isometry3d truth =
        pose_of(-first_offset).inverse() * pose_of(begin - first_offset);
    max_error =
        std::max(max_error, testing::position_error(estimate.T_world_sensor.isometry(), truth));
  }
  return max_error;
}

TEST(MotionCompensation, DeskewsScanToItsStamp) {
  LabeledCloud cloud = scan_at(1.5);
  EXPECT_GT(max_face_distance(cloud, pose_at(1.5)), 0.15);
  deskew(cloud, velocity());
  EXPECT_LT(max_face_distance(cloud, pose_at(1.5)), 5e-3);
}

TEST(MotionCompensation, DeskewsFeaturesToCenterOfScan) {
  FeatureCloud features = FeatureExtractor({}).extract(scan_at(1.5));
  EXPECT_NEAR(to_seconds(features.points_offset), 0.5 * kPeriod, 1e-3);
  deskew(features, velocity());
  const Eigen::Isometry3d center = pose_at(1.5 + 0.5 * kPeriod);
  ASSERT_GT(features.planes.size(), 300U);
  for (const PlaneFeature& plane : features.planes) {
    const Eigen::Vector3d point = center * plane.point.cast<double>();
    const bool is_near_crease = hall().distance_to_crease(point) < 0.8;
    EXPECT_LT(hall().distance_to_face(point), is_near_crease ? 0.06 : 5e-3);
  }
}

TEST(MotionCompensation, KeepsCloudsWithoutTimeOffsets) {
  LabeledCloud cloud = scan_at(1.5);
  cloud.time_offset.clear();
  const auto before = cloud.points;
  deskew(cloud, velocity());
  EXPECT_EQ(cloud.points, before);
}

TEST(MotionCompensation, EstimatesPoseAtStampAnywhereInScan) {
  EXPECT_LT(max_position_error(pose_at, true), 0.03);
  EXPECT_LT(max_position_error(pose_at, true, -kPeriod), 0.03);  // stamped at the last point
  EXPECT_GT(max_position_error(pose_at, false), 0.06);
}

TEST(MotionCompensation, DeskewsAgainInASuddenTurn) {
  const double stamped_at_start = max_position_error(pose_in_sudden_turn_at, true);
  EXPECT_LT(stamped_at_start, 0.04);
  EXPECT_LT(max_position_error(pose_in_sudden_turn_at, true, -kPeriod), 0.04);
  EXPECT_LT(max_position_error(pose_in_sudden_turn_at, true, -0.5 * kPeriod), 0.04);
}

TEST(MotionCompensation, TracksFromStartInMotion) {
  EXPECT_LT(max_position_error(pose_in_motion_at, true), 0.03);
  EXPECT_LT(max_position_error(pose_in_motion_at, true, -kPeriod), 0.03);
  EXPECT_LT(max_position_error(pose_in_motion_at, true, -0.5 * kPeriod), 0.03);  // at its center
}

TEST(MotionCompensation, GivesTheVelocityThatSkewedTheFirstTwoScans) {
  for (const bool moves : {false, true}) {
    Odometry odometry({}, {});
    for (int i = 0; i < 2; ++i) {
      LabeledCloud scan =
          scan_at(kPeriod * (i - (moves ? 0 : 10)), 0.0, moves ? pose_in_motion_at : pose_at);
      scan.stamp = Timestamp::from_seconds(1.0 + kPeriod * i);
      odometry.estimate(FeatureExtractor({}).extract(scan));
    }
    EXPECT_EQ(odometry.begins_anew(), moves);
    ASSERT_EQ(odometry.unexpected_velocity().has_value(), moves);
    if (moves) {
      EXPECT_LT((*odometry.unexpected_velocity() - velocity()).norm(), 0.15);
    }
  }
}

TEST(MotionCompensation, RelocatesAScanAtItsStamp) {
  Odometry odometry({}, {});
  const auto next = [&](int i) {
    LabeledCloud scan = scan_at(kPeriod * i, 0.0, pose_in_motion_at);
    scan.stamp = Timestamp::from_seconds(1.0 + kPeriod * i);
    return odometry.estimate(FeatureExtractor({}).extract(scan));
  };
  for (int i = 0; i < 5; ++i) next(i);
  const auto before = next(5);
  odometry.relocate(before.stamp, before.T_world_sensor, {});  // where it is
  EXPECT_LT(
      testing::position_error(next(6).T_world_sensor.isometry(), pose_in_motion_at(6 * kPeriod)),
      0.02);
}

}  // namespace
}  // namespace mms
