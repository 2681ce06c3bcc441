#include "mms/mapping/tracking/motion_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

const Eigen::Vector3d kUp(0, 0, 1);

TEST(MotionFilter, ConvergesToConstantVelocity) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.2, 1.0);
  const Eigen::Vector3d velocity(1.0, -0.5, 0.0);
  for (int i = 1; i <= 300; ++i) {
    filter.predict(1.0 / 30.0, 0.1);
    filter.update(velocity * (i / 30.0), {0.05});
  }
  EXPECT_TRUE(filter.velocity().isApprox(velocity, 1e-3));
  EXPECT_TRUE(filter.position().isApprox(10.0 * velocity, 1e-4));
}

TEST(MotionFilter, PredictionIsIndependentOfStepSize) {
  MotionFilter one_step(Eigen::Vector3d(1, 2, 3), kUp, 0.1, 0.5);
  MotionFilter two_steps = one_step;
  one_step.predict(0.4, 0.2);
  two_steps.predict(0.1, 0.2);
  two_steps.predict(0.3, 0.2);
  EXPECT_TRUE(one_step.position_covariance().isApprox(two_steps.position_covariance(), 1e-12));
  EXPECT_TRUE(one_step.velocity_covariance().isApprox(two_steps.velocity_covariance(), 1e-12));
}

TEST(MotionFilter, CovarianceMatchesError) {
  // White noise of the measurements: errors are within three sigma nearly always.
  RandomStream random(5);
  const double sigma = 0.05;
  int outside = 0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.05, 1.0);
    for (int i = 1; i <= 60; ++i) {
      filter.predict(1.0 / 30.0, 1e-4);
      Eigen::Vector3d noise;
      for (double& value : noise) {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) sum += static_cast<double>(random.uniform());
        value = sigma * sum;
      }
      filter.update(Eigen::Vector3d(i / 30.0, 0, 0) + noise, {sigma});
    }
    const double error = filter.velocity().x() - 1.0;
    if (std::abs(error) > 3.0 * std::sqrt(filter.velocity_covariance()(0, 0))) ++outside;
  }
  EXPECT_LT(outside, runs / 25);
}

TEST(MotionFilter, AppearingHeightIsNoVerticalMotion) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
  for (int i = 1; i <= 60; ++i) {
    filter.predict(1.0 / 30.0, 0.1);
    filter.update({0.0, 0.0, std::min(1.0, 0.05 * i)}, {0.05});
  }
  EXPECT_NEAR(filter.velocity().norm(), 0.0, 1e-9);
  EXPECT_NEAR(filter.position().z(), 1.0, 0.02);
}

TEST(MotionFilter, LimitsInfluenceOfOutliers) {
  // Change of the velocity by one measurement with that error [m].
  const auto velocity_error = [](double error) {
    MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
    for (int i = 1; i <= 61; ++i) {
      filter.predict(1.0 / 30.0, 0.1);
      filter.update({i / 30.0 + (i == 61 ? error : 0.0), 0.0, 0.0}, {0.03});
    }
    return filter.velocity().x() - 1.0;
  };
  EXPECT_NEAR(velocity_error(0.04), 2.0 * velocity_error(0.02), 1e-3);
  EXPECT_LT(velocity_error(1.0), 3.0 * velocity_error(0.1));
}

/// Largest velocity error of a point at 1 m/s whose measured position has an offset of 0.3 m in
/// frames [offset_begin, offset_end) of 75. The first 15 frames do not count.
double worst_velocity(int offset_begin, int offset_end, const PositionError& error_with_offset) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.3, 0.7);
  double worst = 0.0;
  for (int i = 1; i <= 75; ++i) {
    filter.predict(1.0 / 15.0, 0.2);
    const bool has_offset = i >= offset_begin && i < offset_end;
    filter.update({i / 15.0 + (has_offset ? 0.3 : 0.0), 0.0, 0.0},
                  has_offset ? error_with_offset : PositionError{0.03, 0.0});
    if (i >= 15) worst = std::max(worst, std::abs(filter.velocity().x() - 1.0));
  }
  return worst;
}

TEST(MotionFilter, TemporaryOffsetIsNoMotion) {
  EXPECT_LT(worst_velocity(30, 45, {0.03, 0.3}), 0.2);
  EXPECT_GT(worst_velocity(30, 45, {0.03, 0.0}), 0.6);
}

TEST(MotionFilter, InitialOffsetIsNoMotion) {
  EXPECT_LT(worst_velocity(0, 25, {0.03, 0.3}), 0.3);
  EXPECT_GT(worst_velocity(0, 25, {0.03, 0.0}), 0.6);
}

TEST(MotionFilter, CompleteViewReducesPositionCovariance) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.3, 0.7);
  for (int i = 1; i <= 30; ++i) {
    filter.predict(1.0 / 15.0, 0.2);
    filter.update({0.3, 0.0, 0.0}, {0.03, 0.3});
  }
  EXPECT_GT(filter.position_covariance()(0, 0), 0.1 * 0.1);
  filter.predict(1.0 / 15.0, 0.2);
  filter.update({0.0, 0.0, 0.0}, {0.03, 0.0});
  EXPECT_LT(filter.position_covariance()(0, 0), 0.03 * 0.03);
  EXPECT_NEAR(filter.position().x(), 0.0, 0.03);
}

TEST(MotionFilter, ShiftKeepsVelocity) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.1, 1.0);
  filter.shift({0.5, 0.0, 0.0});
  EXPECT_EQ(filter.position().x(), 0.5);
  EXPECT_EQ(filter.velocity().norm(), 0.0);
}

TEST(MotionFilter, SetUpRemovesVerticalVelocity) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.01, 10.0);
  filter.predict(1.0, 0.1);
  filter.update({1.0, 0.0, 0.0}, {0.001});
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  filter.set_up(up);
  EXPECT_NEAR(filter.velocity().dot(up), 0.0, 1e-12);
  EXPECT_NEAR(up.dot(filter.velocity_covariance() * up), 0.0, 1e-12);
  EXPECT_NEAR(filter.velocity().norm(), 1.0, 0.02);
}

TEST(MotionFilter, LimitsSpeedNotDirection) {
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.01, 100.0);
  filter.predict(1.0, 0.1);
  filter.update({3.0, 4.0, 0.0}, {0.001});
  filter.limit_speed(2.5);
  EXPECT_NEAR(filter.velocity().norm(), 2.5, 1e-9);
  EXPECT_NEAR(filter.velocity().y() / filter.velocity().x(), 4.0 / 3.0, 1e-6);
}

/// A path with random accelerations, its noisy measurements and the filter after each of them.
struct Walk {
  static constexpr double kStep = 0.1;   // [s]
  static constexpr double kNoise = 0.3;  // of the acceleration [m^2/s^3]
  static constexpr double kSigma = 0.05;
  std::vector<Eigen::Vector3d> measurements;
  std::vector<MotionFilter> filters;  // after each measurement

  explicit Walk(int steps) {
    RandomStream random(3);
    Eigen::Vector3d velocity(1, 0.5, 0);
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    MotionFilter filter(position, kUp, 0.2, 1.0);
    for (int i = 0; i < steps; ++i) {
      if (i > 0) filter.predict(kStep, kNoise);
      const auto error = [&] { return 2.0 * static_cast<double>(random.uniform()) - 1.0; };
      measurements.push_back(position + kSigma * Eigen::Vector3d(error(), error(), error()));
      filter.update(measurements.back(), {kSigma});
      filters.push_back(filter);
      velocity += Eigen::Vector3d(0.2 * error(), 0.2 * error(), 0.0);
      position += kStep * velocity;
    }
  }

  void smooth() {
    for (std::size_t i = filters.size() - 1; i-- > 0;) {
      filters[i].smooth(filters[i + 1], kStep, kNoise);
    }
  }

  /// x and its velocity at all steps, by batch least squares.
  Eigen::VectorXd batch() const {
    const auto n = static_cast<Eigen::Index>(measurements.size());
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
    information(0, 0) += 1.0 / (0.2 * 0.2);
    information(1, 1) += 1.0;
    Eigen::Matrix2d noise;
    noise << kStep * kStep * kStep / 3.0, kStep * kStep / 2.0, kStep * kStep / 2.0, kStep;
    Eigen::Matrix<double, 2, 4> motion;
    motion << -1.0, -kStep, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      information(2 * i, 2 * i) += 1.0 / (kSigma * kSigma);
      right(2 * i) += measurements[static_cast<std::size_t>(i)].x() / (kSigma * kSigma);
      if (i == 0) continue;
      information.block<4, 4>(2 * i - 2, 2 * i - 2) +=
          motion.transpose() * (kNoise * noise).inverse() * motion;
    }
    return information.ldlt().solve(right);
  }
};

TEST(MotionFilter, SmootherEqualsBatchLeastSquares) {
  Walk walk(40);
  const Eigen::VectorXd expected = walk.batch();
  walk.smooth();
  for (std::size_t i = 0; i < walk.filters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    EXPECT_NEAR(walk.filters[i].position().x(), expected(row), 1e-5) << "step " << i;
    EXPECT_NEAR(walk.filters[i].velocity().x(), expected(row + 1), 1e-4) << "step " << i;
  }
}

TEST(MotionFilter, SmoothingReducesCovariance) {
  Walk walk(40);
  const std::vector<MotionFilter> before = walk.filters;
  walk.smooth();
  for (std::size_t i = 0; i + 1 < before.size(); ++i) {
    const double now = walk.filters[i].velocity_covariance().trace();
    EXPECT_GT(now, 0.0);
    EXPECT_LT(now, before[i].velocity_covariance().trace());
  }
}

TEST(MotionFilter, SmoothingFromPredictionChangesNothing) {
  MotionFilter filter = Walk(20).filters.back();
  const MotionFilter before = filter;
  MotionFilter later = filter;
  later.predict(0.2, 0.3);
  filter.smooth(later, 0.2, 0.3);
  EXPECT_TRUE(filter.position().isApprox(before.position(), 1e-9));
  EXPECT_TRUE(filter.velocity().isApprox(before.velocity(), 1e-9));
  EXPECT_TRUE(filter.velocity_covariance().isApprox(before.velocity_covariance(), 1e-6));
}

TEST(MotionFilter, ShiftDoesNotAffectSmoothing) {
  Walk straight(40);
  Walk shifted = straight;
  const Eigen::Vector3d shift(0.5, 0.0, 0.0);
  MotionFilter last = straight.filters.back();
  last.predict(Walk::kStep, Walk::kNoise);
  MotionFilter moved = last;
  moved.shift(shift);
  straight.filters.push_back(last);
  shifted.filters.push_back(moved);
  straight.smooth();
  shifted.smooth();
  const std::size_t k = straight.filters.size() - 2;
  EXPECT_TRUE(shifted.filters[k].velocity().isApprox(straight.filters[k].velocity(), 1e-9));
  EXPECT_TRUE(shifted.filters[k].position().isApprox(straight.filters[k].position(), 1e-9));
}

TEST(MotionFilter, SmootherIgnoresTruncationOffset) {
  // A static object, first truncated, then complete.
  std::vector<MotionFilter> filters;
  MotionFilter filter(Eigen::Vector3d::Zero(), kUp, 0.2, 0.7);
  for (int i = 0; i < 40; ++i) {
    if (i > 0) filter.predict(0.1, 0.2);
    const bool is_truncated = i < 20;
    filter.update(Eigen::Vector3d(is_truncated ? -0.2 : 0.0, 0, 0),
                  {0.03, is_truncated ? 0.2 : 0.0});
    filters.push_back(filter);
  }
  const double before = filters[10].position().norm();
  for (std::size_t i = filters.size() - 1; i-- > 0;) filters[i].smooth(filters[i + 1], 0.1, 0.2);
  for (const MotionFilter& smoothed : filters) EXPECT_LT(smoothed.velocity().norm(), 0.15);
  EXPECT_LT(filters[10].position().norm(), 0.8 * before);
}

}  // namespace
}  // namespace mms
