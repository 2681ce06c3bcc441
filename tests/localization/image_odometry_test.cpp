#include <gtest/gtest.h>

#include <vector>

#include "mms/localization/features/feature_extractor.hpp"
#include "mms/localization/odometry.hpp"
#include "tests/geometry/threads.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;
using testing::motion;
using testing::position_error;

constexpr std::int64_t kMillisecond = 1'000'000;

/// Ground truth of a trajectory with constant velocity through the room.
Eigen::Isometry3d truth_at(Timestamp stamp) {
  const double t = stamp.seconds();
  return motion(0.3 * t, -0.1 * t, 0.2 * t, 0.05 * t, 0.2 * t, -0.1 * t);
}

double error_of(const OdometryEstimate& estimate) {
  return position_error(estimate.T_world_sensor.isometry(), truth_at(estimate.stamp));
}

/// Extraction, photometric term and odometry over noisy images.
std::vector<OdometryEstimate> image_odometry(Association association) {
  FeatureExtractor extractor{FeatureConfig{}};
  OdometryConfig config;
  config.registration.geometric.association = association;
  Odometry odometry(config, {});
  std::vector<OdometryEstimate> estimates;
  for (int ms = 0; ms <= 500; ms += 50) {
    const Timestamp stamp(ms * kMillisecond);
    LabeledCloud cloud =
        testing::organised_cloud(BoxRoom{}, truth_at(stamp), 1.0, static_cast<unsigned>(ms));
    cloud.stamp = stamp;
    estimates.push_back(odometry.estimate(extractor.extract(cloud)));
  }
  return estimates;
}

class ImageOdometry : public ::testing::TestWithParam<Association> {};
INSTANTIATE_TEST_SUITE_P(Odometry, ImageOdometry,
                         ::testing::Values(Association::kPaper, Association::kSurface),
                         testing::association_name);

TEST_P(ImageOdometry, TracksCamera) {
  for (const OdometryEstimate& estimate : image_odometry(GetParam())) {
    EXPECT_LT(error_of(estimate), 0.01);
    if (estimate.status == Status::kInitialized) continue;
    EXPECT_EQ(estimate.status, Status::kTracking);
    EXPECT_GT(estimate.intensity_inliers, 300);
  }
}

TEST_P(ImageOdometry, SameBitsForAnyThreadCount) {
  const auto run = [&] { return image_odometry(GetParam()); };
  const auto one = testing::on_threads(1, run);
  for (const int threads : {2, 4}) {
    const auto many = testing::on_threads(threads, run);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].T_world_sensor.isometry().matrix(),
                one[i].T_world_sensor.isometry().matrix());
      EXPECT_EQ(many[i].information, one[i].information);
    }
  }
}

}  // namespace
}  // namespace mms
