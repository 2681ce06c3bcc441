#include "mms/dataset/kitti_lidar.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

const std::string kPoint(16, '\0');

TEST(KittiLidar, ReadsScansAndPoses) {
  const TempFolder folder;
  folder.write("000000.bin", kPoint);
  folder.write("000001.bin", kPoint + kPoint);
  folder.write("poses_gt.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 7 0 1 0 0 0 0 1 0\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "000000 000001");
  EXPECT_EQ(played.frames[1].stamp, Timestamp(100'000'000));
  EXPECT_EQ(played.frames[1].scan.points.size(), 2U);
  EXPECT_FALSE(played.frames[1].has_depth());
  ASSERT_NE(played.frames[1].calibration, nullptr);
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_EQ(played.source->ground_truth()[1].T_world_sensor.translation().x(), 7.0);
}

TEST(KittiLidar, PosesAreTakenToTheScanner) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("poses.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n");
  folder.write("calibration.yaml", "T_camera_lidar: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const auto source = open_dataset(folder.path());
  EXPECT_EQ(source->ground_truth()[0].T_world_sensor.translation().x(), 7.5);
}

TEST(KittiLidar, StampsFromTimes) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("velodyne/1.bin", kPoint);
  folder.write("times.txt", "3.5e+00\n3.6\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames[0].stamp, Timestamp(3'500'000'000));
  folder.write("times.txt", "3.5\n");
  expect_in("has 1 stamps for 2 scans",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(KittiLidar, EmptyAndTruncatedScansAreSkipped) {
  const TempFolder folder;
  folder.write("0.bin", "");
  folder.write("1.bin", "12345");
  folder.write("2.bin", kPoint);
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "2");
  EXPECT_EQ(played.source->skipped(), 2U);
  EXPECT_TRUE(any_has(played.warnings, "frame 0 skipped: "));
}

TEST(KittiLidar, ReadsTheSharedScans) {
  const std::filesystem::path shared =
      std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/lidar/kitti00_6scans";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared data";
  const Playback played(open_dataset(shared));
  EXPECT_EQ(played.frames.size(), 6U);
  EXPECT_EQ(played.source->ground_truth().size(), 6U);
}

}  // namespace
}  // namespace mms
