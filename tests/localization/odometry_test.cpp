#include "mms/localization/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;
using testing::motion;
using testing::position_error;

constexpr std::int64_t kMillisecond = 1'000'000;

/// A steady drive through the room, truth at any instant.
Eigen::Isometry3d truth_at(Timestamp stamp) {
  const double t = stamp.seconds();
  return motion(0.3 * t, -0.1 * t, 0.2 * t, 0.05 * t, 0.2 * t, -0.1 * t);
}

FeatureCloud features_at(std::int64_t milliseconds) {
  const Timestamp stamp(milliseconds * kMillisecond);
  FeatureCloud features = testing::exact_features(BoxRoom{}, truth_at(stamp), 16);
  features.stamp = stamp;
  return features;
}

FeatureCloud nothing_at(std::int64_t milliseconds) {
  FeatureCloud features;
  features.stamp = Timestamp(milliseconds * kMillisecond);
  return features;
}

/// As many features as in `features_at`, but anywhere, with any normal.
FeatureCloud nonsense_at(std::int64_t milliseconds) {
  FeatureCloud features = features_at(milliseconds);
  std::mt19937 random(static_cast<unsigned>(milliseconds));
  std::uniform_real_distribution<float> any(-1.0F, 1.0F);
  const auto vector = [&] {
    return Eigen::Vector3f(Eigen::Vector3f::NullaryExpr([&] { return any(random); }));
  };
  for (auto& f : features.planes) {
    f.point = 2.0F * vector();
    f.normal = vector().normalized();
  }
  for (auto& f : features.edges) f.point = 2.0F * vector();
  return features;
}

double error_of(const OdometryEstimate& estimate) {
  return position_error(estimate.T_world_sensor.isometry(), truth_at(estimate.stamp));
}

TEST(Odometry, TheFirstFrameIsTheOrigin) {
  Odometry odometry({}, {});
  const auto estimate = odometry.estimate(features_at(0));
  EXPECT_EQ(estimate.status, Status::kInitialized);
  EXPECT_TRUE(estimate.T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
}

TEST(Odometry, TooFewFeaturesDoNotInitialise) {
  Odometry odometry({}, {});
  EXPECT_EQ(odometry.estimate(nothing_at(0)).status, Status::kLost);
  EXPECT_EQ(odometry.estimate(nothing_at(50)).status, Status::kLost);
  const auto first = odometry.estimate(features_at(100));
  EXPECT_EQ(first.status, Status::kInitialized);
  EXPECT_TRUE(first.T_world_sensor.isometry().isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(odometry.estimate(features_at(150)).status, Status::kTracking);
}

TEST(Odometry, TracksIrregularStamps) {
  Odometry odometry({}, {});
  for (const int ms : {0, 30, 60, 63, 160, 190, 290, 291, 420, 450, 700, 730, 1000}) {
    const auto estimate = odometry.estimate(features_at(ms));
    EXPECT_EQ(estimate.status, ms == 0 ? Status::kInitialized : Status::kTracking) << ms;
    EXPECT_EQ(estimate.stamp, Timestamp(ms * kMillisecond));
    EXPECT_LT(error_of(estimate), 2e-3) << ms;
    EXPECT_EQ(estimate.degenerate_directions, 0);
  }
}

TEST(Odometry, LosesTheWayAndFindsItAgain) {
  Odometry odometry({}, {});
  std::vector<Status> statuses;
  std::vector<OdometryEstimate> estimates;
  for (int ms = 0; ms <= 1000; ms += 50) {
    const bool blind = ms >= 500 && ms < 700;
    estimates.push_back(odometry.estimate(blind ? nothing_at(ms) : features_at(ms)));
    const Status expected = ms == 0     ? Status::kInitialized
                            : blind     ? Status::kLost
                            : ms == 700 ? Status::kRecovered
                                        : Status::kTracking;
    EXPECT_EQ(estimates.back().status, expected) << ms;
    EXPECT_TRUE(blind || error_of(estimates.back()) < 2e-3) << ms;
  }
  // Lost, it goes on in the direction it went, ever more slowly.
  const auto step = [&](std::size_t i) {
    return position_error(estimates[i].T_world_sensor.isometry(),
                          estimates[i - 1].T_world_sensor.isometry());
  };
  EXPECT_NEAR(step(10), step(9), 0.2 * step(9));
  EXPECT_LT(step(12), 0.7 * step(10));
  EXPECT_GT(step(12), 0.0);
}

TEST(Odometry, ALostFrameIsStillExpectedForAMoment) {
  Odometry odometry({}, {});
  for (int ms = 0; ms <= 500; ms += 50) odometry.estimate(features_at(ms));
  odometry.estimate(nothing_at(550));
  const Timestamp next(600 * kMillisecond);
  const auto expected = odometry.expected(next);
  ASSERT_TRUE(expected);
  EXPECT_LT(position_error(expected->isometry(), truth_at(next)), 0.02);
  for (int ms = 600; ms <= 1500; ms += 50) odometry.estimate(nothing_at(ms));
  EXPECT_FALSE(odometry.expected(Timestamp(1550 * kMillisecond)));
}

TEST(Odometry, LostFramesDoNotChangeTheMaps) {
  Odometry blinded({}, {});
  Odometry fooled({}, {});
  for (int ms = 0; ms <= 1000; ms += 50) {
    const bool bad = ms >= 500 && ms < 650;
    const auto a = blinded.estimate(bad ? nothing_at(ms) : features_at(ms));
    const auto b = fooled.estimate(bad ? nonsense_at(ms) : features_at(ms));
    EXPECT_EQ(a.status, b.status) << ms;
    EXPECT_EQ(a.status == Status::kLost, bad) << ms;
    EXPECT_EQ(a.T_world_sensor.isometry().matrix(), b.T_world_sensor.isometry().matrix()) << ms;
  }
}

TEST(Odometry, AJumpIsNotBelieved) {
  OdometryConfig config;
  config.motion.max_speed = 1.0;
  Odometry odometry(config, {});
  odometry.estimate(features_at(0));
  odometry.estimate(features_at(50));
  FeatureCloud jump = testing::exact_features(
      BoxRoom{}, truth_at(Timestamp(50 * kMillisecond)) * motion(0.2, 0, 0, 0, 0, 0), 16);
  jump.stamp = Timestamp(100 * kMillisecond);
  EXPECT_EQ(odometry.estimate(jump).status, Status::kLost);
}

TEST(Odometry, AJerkIsNotBelievedOnceTheVelocityIsKnown) {
  const auto pushed = [](double metres) {
    FeatureCloud features = testing::exact_features(
        BoxRoom{}, truth_at(Timestamp(50 * kMillisecond)) * motion(metres, 0, 0, 0, 0, 0), 16);
    features.stamp = Timestamp(100 * kMillisecond);
    return features;
  };
  for (const auto& [acceleration, status] :
       {std::pair{10.0, Status::kLost}, {1000.0, Status::kTracking}}) {
    OdometryConfig config;
    config.motion.max_acceleration = acceleration;
    config.motion.acceleration = 0.1 * acceleration;
    Odometry odometry(config, {});
    odometry.estimate(features_at(0));
    odometry.estimate(features_at(50));
    EXPECT_EQ(odometry.estimate(pushed(0.2)).status, status) << acceleration;
  }
}

TEST(Odometry, OneWallIsReportedDegenerate) {
  const auto wall_at = [](int ms) {
    FeatureCloud features = features_at(ms);
    features.edges.clear();
    const Eigen::Isometry3d T = truth_at(features.stamp);
    std::erase_if(features.planes,
                  [&](const PlaneFeature& f) { return (T * f.point.cast<double>()).z() < 3.99; });
    return features;
  };
  OdometryConfig config;
  config.min_inliers = 20;
  Odometry odometry(config, {});
  odometry.estimate(wall_at(0));
  const auto estimate = odometry.estimate(wall_at(50));
  EXPECT_EQ(estimate.status, Status::kDegenerate);
  EXPECT_EQ(estimate.degenerate_directions, 3);
}

TEST(Odometry, DepthTakenLaterThanTheImageIsMovedBack) {
  const auto drive = [](bool tell) {
    Odometry odometry({}, {});
    double worst = 0.0;
    for (int ms = 0; ms <= 600; ms += 50) {
      const int late = ms == 0 ? 0 : 10;
      FeatureCloud features = features_at(ms + late);
      features.stamp = Timestamp(ms * kMillisecond);
      if (tell) features.points_offset = Duration(late * kMillisecond);
      const auto estimate = odometry.estimate(features);
      if (ms > 200) worst = std::max(worst, error_of(estimate));
    }
    return worst;
  };
  EXPECT_GT(drive(false), 3e-3);  // 10 ms at 0.37 m/s
  EXPECT_LT(drive(true), 1e-3);
}

TEST(Odometry, DepthNearlyAFrameLateDoesNotDiverge) {
  Odometry odometry({}, {});
  double worst = 0.0;
  for (int ms = 0; ms <= 1000; ms += 25) {
    FeatureCloud features = features_at(ms + 20);
    features.stamp = Timestamp(ms * kMillisecond);
    features.points_offset = Duration(20 * kMillisecond);
    worst = std::max(worst, error_of(odometry.estimate(features)));
  }
  EXPECT_LT(worst, 2e-2);  // 20 ms at 0.37 m/s are 7 mm; fed back, they would be metres
}

TEST(Odometry, EqualStampsAreSurvived) {
  Odometry odometry({}, {});
  odometry.estimate(features_at(0));
  for (int i = 0; i < 3; ++i) {
    const auto estimate = odometry.estimate(features_at(0));
    EXPECT_TRUE(estimate.T_world_sensor.is_finite());
    EXPECT_LT(error_of(estimate), 1e-3);
  }
  EXPECT_LT(error_of(odometry.estimate(features_at(50))), 2e-3);
}

}  // namespace
}  // namespace mms
