#include "mms/evaluation/trajectory/kitti_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/evaluation/trajectories.hpp"

namespace mms {
namespace {

/// 301 poses along a straight path.
Trajectory straight(double step) {
  std::vector<double> positions;
  for (int i = 0; i <= 300; ++i) positions.push_back(step * i);
  return test::along_x(positions);
}

KittiDrift drift_of(const Trajectory& truth, const Trajectory& estimate) {
  return kitti_drift(truth, estimate, match_by_index(truth, estimate));
}

TEST(KittiDrift, IsErrorPerLengthOfTruePath) {
  const KittiDrift drift = drift_of(straight(1.0), straight(1.01));
  // The first poses beyond 100 and 200 m are at 101 and 201 m: 20 and 10 parts.
  EXPECT_EQ(drift.parts, 30U);
  EXPECT_NEAR(drift.trans_pct, (20 * 1.01 + 10 * 1.005) / 30, 1e-9);
  EXPECT_NEAR(drift.rot_deg_per_100m, 0.0, 1e-6);
}

TEST(KittiDrift, RotationIsPerHundredMeters) {
  Trajectory estimate = straight(1.0);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double angle = 0.1 * static_cast<double>(i) * std::numbers::pi / 180.0;
    Eigen::Isometry3d pose = estimate[i].T_world_sensor.isometry();
    pose.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
    estimate[i].T_world_sensor = Transform<World, Sensor>(pose);
  }
  const KittiDrift drift = drift_of(straight(1.0), estimate);
  EXPECT_NEAR(drift.rot_deg_per_100m, (20 * 10.1 + 10 * 10.05) / 30, 1e-9);
  EXPECT_NEAR(drift.trans_pct, 0.0, 1e-9);
}

TEST(KittiDrift, IsUndefinedForShortPath) {
  const KittiDrift drift = drift_of(straight(0.3), straight(0.3));
  EXPECT_EQ(drift.parts, 0U);
  EXPECT_TRUE(std::isnan(drift.trans_pct));
  EXPECT_TRUE(std::isnan(drift.rot_deg_per_100m));
}

}  // namespace
}  // namespace mms
