#include "mms/evaluation/trajectory/trajectory_error.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "mms/core/error.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "tests/evaluation/trajectories.hpp"

namespace mms {
namespace {

std::string message_of(const Trajectory& reference, const Trajectory& estimate) {
  try {
    evaluate_trajectory(reference, estimate);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(TrajectoryError, IsZeroInAnotherWorldFrame) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const Trajectory truth = test::random_walk(random, 50);
    const auto error =
        evaluate_trajectory(truth, test::moved(truth, test::random_isometry(random, 20.0, 1.5)));
    EXPECT_EQ(error.matched, 50U);
    EXPECT_LT(error.ate_max_m, 1e-9);
    EXPECT_LT(error.rpe.trans_rmse_m, 1e-9);
    EXPECT_LT(error.rpe.rot_rmse_deg, 1e-5);
  }
}

TEST(TrajectoryError, AteOfKnownOffsets) {
  // Offsets of +-d normal to a large square have no rotation and no mean: alignment keeps them.
  Trajectory truth;
  Trajectory estimate;
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  const std::vector<double> offsets = {0.1, -0.1, 0.1, -0.1};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto stamp = Timestamp() + static_cast<std::int64_t>(i) * test::kPeriod;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = corners[i];
    truth.push_back({stamp, Transform<World, Sensor>(pose)});
    pose.translation().z() += offsets[i];
    estimate.push_back({stamp, Transform<World, Sensor>(pose)});
  }
  const auto error = evaluate_trajectory(truth, estimate);
  EXPECT_NEAR(error.ate_rmse_m, 0.1, 1e-12);
  EXPECT_NEAR(error.ate_mean_m, 0.1, 1e-12);
  EXPECT_NEAR(error.ate_median_m, 0.1, 1e-12);
  EXPECT_NEAR(error.ate_max_m, 0.1, 1e-12);
}

TEST(TrajectoryError, WithoutAlignmentAnOffsetCounts) {
  std::mt19937 random(3);
  const Trajectory truth = test::random_walk(random, 50);
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() = Eigen::Vector3d(0.3, 0.0, 0.4);
  const auto error = evaluate_trajectory(truth, test::moved(truth, offset), {.align = false});
  EXPECT_NEAR(error.ate_rmse_m, 0.5, 1e-9);
}

TEST(TrajectoryError, TooFewMatchesNameCountsAndStamps) {
  const Trajectory reference = test::along_x({0, 1, 2, 3});
  Trajectory estimate = reference;
  for (StampedPose& pose : estimate) pose.stamp = pose.stamp + std::chrono::hours(1);
  estimate[0].stamp = reference[0].stamp;
  const std::string message = message_of(reference, estimate);
  EXPECT_NE(message.find("1 of 4"), std::string::npos) << message;
  EXPECT_NE(message.find("at least 3"), std::string::npos) << message;
  EXPECT_NE(message.find("3600.300000000"), std::string::npos) << message;
}

TEST(TrajectoryError, RejectsEmptyTrajectories) {
  EXPECT_NE(message_of({}, {}), "");
}

TEST(TrajectoryError, CountsUnmatchedPoses) {
  const Trajectory reference = test::along_x({0, 1, 2, 3});
  const auto error = evaluate_trajectory(reference, test::along_x({0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(error.matched, 4U);
  EXPECT_EQ(error.poses, 6U);
}

TEST(TrajectoryError, JsonHasDocumentedKeysInOrder) {
  EXPECT_EQ(
      to_json(metric_values(TrajectoryError{.matched = 2, .poses = 3})),
      R"({"matched":2,"poses":3,"path_m":0.0,"ate_rmse_m":0.0,"ate_mean_m":0.0,"ate_median_m":0.0,)"
      R"("ate_max_m":0.0,"rpe_trans_rmse_m":0.0,"rpe_rot_rmse_deg":0.0})");
}

/// Recordings with results of the reference implementation; they are not part of the repository.
class Gold : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " does not exist";
  }

  Trajectory read(const std::string& name) const { return read_trajectory(folder_ / name); }

  static void expect_ate(const TrajectoryError& error, double rmse, double mean, double median,
                         double max) {
    constexpr double kTolerance = 1e-6;
    EXPECT_NEAR(error.ate_rmse_m, rmse, kTolerance);
    EXPECT_NEAR(error.ate_mean_m, mean, kTolerance);
    EXPECT_NEAR(error.ate_median_m, median, kTolerance);
    EXPECT_NEAR(error.ate_max_m, max, kTolerance);
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(MMS_SOURCE_DIR) / ".." / "shared" / "data" / "trajectories";
};

TEST_F(Gold, Kitti00) {
  const auto error = evaluate_trajectory(read("KITTI_00_gt.txt"), read("KITTI_00_ORB.txt"),
                                         {.matching = Matching::kByIndex});
  EXPECT_EQ(error.matched, 4541U);
  expect_ate(error, 1.303449715, 1.156997129, 1.065624770, 3.587949121);
  EXPECT_NEAR(error.rpe.trans_rmse_m, 0.226261343, 1e-6);
}

TEST_F(Gold, Freiburg1Xyz) {
  const auto error = evaluate_trajectory(read("freiburg1_xyz-groundtruth.txt"),
                                         read("freiburg1_xyz-rgbdslam_drift.txt"),
                                         {.max_difference = std::chrono::milliseconds(10)});
  EXPECT_EQ(error.matched, 785U);
  expect_ate(error, 0.013470119, 0.012024516, 0.011183138, 0.034759897);
}

TEST_F(Gold, Freiburg3WalkingXyz) {
  const auto error = evaluate_trajectory(read("fr3_walking_xyz-groundtruth.txt"),
                                         read("fr3_walking_xyz-estimate.txt"));
  EXPECT_EQ(error.matched, 826U);
  expect_ate(error, 0.015881181, 0.013790642, 0.012320494, 0.057617119);
}

}  // namespace
}  // namespace mms
