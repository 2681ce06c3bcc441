#include "mms/run/view/live_truth.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(LiveTruth, MovesWithTheFrameThatItIsAlignedBy) {
  const auto at = [](double seconds, double x) {
    return StampedPose{
        Timestamp::from_seconds(seconds),
        Transform<World, Sensor>(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)))};
  };
  LiveTruth truth({at(0.0, 5.0), at(1.0, 6.0)});
  EXPECT_NEAR(truth.at(at(0.0, 0.0))->x(), 0.0, 1e-12);
  truth.move(Eigen::Isometry3d(Eigen::Translation3d(0.0, 2.0, 0.0)));
  EXPECT_TRUE(truth.at(at(1.0, 1.0))->isApprox(Eigen::Vector3d(1.0, 2.0, 0.0), 1e-12));
}

}  // namespace
}  // namespace mms
