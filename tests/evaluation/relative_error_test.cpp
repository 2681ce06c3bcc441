#include "mms/evaluation/trajectory/relative_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mms/core/error.hpp"
#include "tests/evaluation/trajectories.hpp"

namespace mms {
namespace {

RelativeError evaluate(const Trajectory& truth, const Trajectory& estimate, double value,
                       DeltaUnit unit) {
  return relative_error(truth, estimate, match_by_index(truth, estimate), {value, unit});
}

std::vector<double> line(int count, double step) {
  std::vector<double> positions;
  for (int i = 0; i < count; ++i) positions.push_back(step * i);
  return positions;
}

TEST(RelativeError, ScaledPathGivesExcessPerDelta) {
  const Trajectory truth = test::along_x(line(51, 0.10));
  const Trajectory estimate = test::along_x(line(51, 0.11));
  const RelativeError second = evaluate(truth, estimate, 1.0, DeltaUnit::kSeconds);
  EXPECT_EQ(second.pairs, 41U);
  EXPECT_NEAR(second.trans_rmse_m, 10 * 0.01, 1e-12);
  EXPECT_NEAR(second.rot_rmse_deg, 0.0, 1e-9);
  const RelativeError frames = evaluate(truth, estimate, 5.0, DeltaUnit::kFrames);
  EXPECT_EQ(frames.pairs, 10U);
  EXPECT_NEAR(frames.trans_rmse_m, 5 * 0.01, 1e-12);
}

TEST(RelativeError, MeterDeltaFollowsEstimatedPath) {
  const Trajectory truth = test::along_x(line(61, 0.2));
  const Trajectory estimate = test::along_x(line(61, 0.25));
  // Ends at 1, 2, ... 15 m of the estimate: 14 pairs of four steps.
  const RelativeError error = evaluate(truth, estimate, 1.0, DeltaUnit::kMeters);
  EXPECT_EQ(error.pairs, 14U);
  EXPECT_NEAR(error.trans_rmse_m, 4 * 0.05, 1e-12);
}

TEST(RelativeError, NoticesOtherAxes) {
  std::mt19937 random(5);
  const Trajectory truth = test::random_walk(random, 60);
  const auto with_axes = [&](double angle) {
    const Eigen::Isometry3d T(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()));
    Trajectory turned = truth;
    for (StampedPose& pose : turned) {
      pose.T_world_sensor = pose.T_world_sensor * Transform<Sensor, Sensor>(T);
    }
    return turned;
  };
  const auto differ = [&](const Trajectory& estimate, double delta) {
    return evaluate(truth, estimate, delta, DeltaUnit::kSeconds).axes_differ;
  };
  EXPECT_TRUE(differ(with_axes(2.0), 1.0));
  EXPECT_TRUE(differ(with_axes(0.5), 1.0));
  EXPECT_FALSE(differ(with_axes(0.05), 1.0));
  EXPECT_FALSE(differ(with_axes(2.0), 5.5)) << "only five pairs";
  EXPECT_FALSE(differ(test::random_walk(random, 60), 1.0)) << "wrong, but not by axes";
}

TEST(RelativeError, RotationDriftGivesAngle) {
  constexpr double kDegreesPerFrame = 0.3;
  Vector6d rotation = Vector6d::Zero();
  rotation[4] = kDegreesPerFrame * std::numbers::pi / 180.0;
  const Trajectory truth = test::along_x(line(30, 0.0));
  Trajectory estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_world_sensor =
        Transform<World, Sensor>(se3::exp(static_cast<double>(i) * rotation));
  }
  const RelativeError error = evaluate(truth, estimate, 1.0, DeltaUnit::kSeconds);
  EXPECT_NEAR(error.rot_rmse_deg, 10 * kDegreesPerFrame, 1e-9);
  EXPECT_NEAR(error.trans_rmse_m, 0.0, 1e-12);
}

TEST(RelativeError, NoPairSpansTimeGap) {
  Trajectory truth = test::along_x(line(20, 0.1));
  for (std::size_t i = 10; i < truth.size(); ++i) {
    truth[i].stamp = truth[i].stamp + std::chrono::seconds(60);
  }
  EXPECT_EQ(evaluate(truth, truth, 0.5, DeltaUnit::kSeconds).pairs, 10U);
}

TEST(RelativeError, IsNanForPathShorterThanDelta) {
  const Trajectory truth = test::along_x(line(5, 0.1));
  for (const DeltaUnit unit : {DeltaUnit::kSeconds, DeltaUnit::kMeters, DeltaUnit::kFrames}) {
    const RelativeError error = evaluate(truth, truth, 10.0, unit);
    EXPECT_EQ(error.pairs, 0U);
    EXPECT_TRUE(std::isnan(error.trans_rmse_m));
  }
}

TEST(RelativeError, DeltaMustBePositive) {
  const Trajectory truth = test::along_x(line(5, 0.1));
  EXPECT_THROW(evaluate(truth, truth, 0.0, DeltaUnit::kSeconds), DataError);
  EXPECT_THROW(evaluate(truth, truth, -1.0, DeltaUnit::kMeters), DataError);
  EXPECT_THROW(evaluate(truth, truth, 0.5, DeltaUnit::kFrames), DataError);
  EXPECT_THROW(evaluate(truth, truth, 1.5, DeltaUnit::kFrames), DataError);
  EXPECT_THROW(evaluate(truth, truth, std::nan(""), DeltaUnit::kSeconds), DataError);
}

}  // namespace
}  // namespace mms
