#include "mms/dataset/kitti/kitti_lidar.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

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

TEST(KittiLidar, TransformsPosesToLidar) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("poses.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n");
  folder.write("calibration.yaml", "T_camera_lidar: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const auto source = open_dataset(folder.path());
  EXPECT_EQ(source->ground_truth()[0].T_world_sensor.translation().x(), 7.5);
}

TEST(KittiLidar, ReadsStampsFromTimes) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("velodyne/1.bin", kPoint);
  folder.write("times.txt", "3.5e+00\n3.6\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames[0].stamp, Timestamp(3'500'000'000));
  folder.write("times.txt", "3.5\n");
  expect_in("has 1 stamps for 2 scans",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

/// A ring of points 10 m away, with these numbers after x y z.
std::string ring_of_points(const std::vector<float>& more) {
  std::string bytes;
  for (int i = 0; i < 720; ++i) {
    const double angle = i * M_PI / 360.0;
    std::vector<float> record = {static_cast<float>(10.0 * std::cos(angle)),
                                 static_cast<float>(10.0 * std::sin(angle)), 0.5F};
    record.insert(record.end(), more.begin(), more.end());
    bytes.append(reinterpret_cast<const char*>(record.data()), record.size() * sizeof(float));
  }
  return bytes;
}

TEST(KittiLidar, RecognizesNumbersOfAPoint) {
  const std::vector<std::vector<float>> records = {{}, {0.5F}, {30, 7}, {30, 7, 0.1F}};
  for (const std::vector<float>& more : records) {
    const TempFolder folder;
    folder.write("0.bin", "");
    folder.write("1.bin", ring_of_points(more));
    const Playback played(open_dataset(folder.path()));
    ASSERT_EQ(played.frames.size(), 1U);
    const LidarScan& scan = played.frames[0].scan;
    ASSERT_EQ(scan.points.size(), 720U) << more.size();
    for (const Eigen::Vector3f& point : scan.points) {
      EXPECT_NEAR(point.head<2>().norm(), 10.0F, 1e-4F);
      EXPECT_EQ(point.z(), 0.5F);
    }
    EXPECT_EQ(scan.intensity.size(), more.empty() ? 0U : 720U);
    EXPECT_TRUE(any_has(played.source->describe(),
                        "points: " + std::to_string(3 + more.size()) + " float32 each"));
  }
}

TEST(KittiLidar, ReadsNuScenes) {
  const TempFolder folder;
  folder.write("n008__LIDAR_TOP__1532402927647951.pcd.bin", ring_of_points({30, 7}));
  folder.write("n008__LIDAR_TOP__1532402927697951.pcd.bin", ring_of_points({30, 7}));
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].scan.points.size(), 720U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'532'402'927'647'951'000));
  EXPECT_EQ(played.frames[1].stamp - played.frames[0].stamp, std::chrono::milliseconds(50));
}

/// The layout of the odometry benchmark: poses of camera 0, images of camera 2.
TEST(KittiLidar, ReadsOdometryBenchmark) {
  const TempFolder folder;
  const std::string sequence = "sequences/03/";
  folder.write(sequence + "velodyne/000000.bin", kPoint);
  folder.write(sequence + "velodyne/000001.bin", kPoint);
  folder.write(sequence + "times.txt", "0.0\n0.1\n");
  // Camera: x right, y down, z forward. LiDAR: x forward, y left, z up, 0.3 m behind the camera.
  folder.write(sequence + "calib.txt",
               "P0: 10 0 4 0 0 10 3 0 0 0 1 0\nP2: 10 0 4 0.6 0 10 3 0 0 0 1 0\n"
               "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  // Camera 0 moves 2 m forward.
  folder.write("poses/03.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 2\n");
  write_color(folder.path() / sequence / "image_2/000000.png");
  const Playback played(open_dataset(folder.path() / sequence));
  ASSERT_EQ(played.frames.size(), 2U);
  const Calibration& calibration = *played.frames[0].calibration;
  ASSERT_TRUE(calibration.camera);
  EXPECT_EQ(calibration.camera->width, kWidth);
  EXPECT_EQ(played.frames[0].color.width(), kWidth);
  // Camera 0 lies 0.06 m to the right in the frame of camera 2.
  const Eigen::Vector3d lidar = calibration.T_camera_lidar.isometry().translation();
  EXPECT_TRUE(lidar.isApprox(Eigen::Vector3d(0.06, 0, -0.3), 1e-9));
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  const Eigen::Isometry3d step =
      played.source->ground_truth()[0].T_world_sensor.isometry().inverse() *
      played.source->ground_truth()[1].T_world_sensor.isometry();
  EXPECT_TRUE(step.translation().isApprox(Eigen::Vector3d(2, 0, 0), 1e-9));
  folder.write(sequence + "calib.txt", "P2: 10 0 4 0 0 10 3 0 0 0 1 0\n");
  expect_in("calib.txt: has no line 'Tr:'",
            message_of<DataError>([&] { open_dataset(folder.path() / sequence); }));
}

TEST(KittiLidar, SkipsEmptyAndTruncatedScans) {
  const TempFolder folder;
  folder.write("0.bin", "");
  folder.write("1.bin", "12345");
  folder.write("2.bin", kPoint);
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "2");
  EXPECT_EQ(played.source->skipped(), 2U);
  EXPECT_TRUE(any_has(played.warnings, "frame 0 skipped: "));
}

/// A folder with two scans of one point and a camera.
void write_scans_with_camera(const TempFolder& folder) {
  folder.write("velodyne/0.bin", kPoint);
  folder.write("velodyne/1.bin", kPoint);
  folder.write("calibration.yaml", kCalibration);
}

TEST(KittiLidar, ReadsImagesMasksAndPointTimes) {
  const TempFolder folder;
  write_scans_with_camera(folder);
  write_color(folder.path() / "image_2/0.png", 77);
  std::filesystem::create_directories(folder.path() / "masks");
  write_png(folder.path() / "masks/1.png", Image<std::uint8_t>(kWidth, kHeight, 2));
  folder.write("point_times/1.bin", std::string("\0\0\0\x3f", 4));  // 0.5 s
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "0 1");
  EXPECT_TRUE(played.source->has_masks());
  EXPECT_EQ(played.frames[0].color(3, 3).r, 77);
  EXPECT_TRUE(played.frames[0].mask.empty());
  EXPECT_TRUE(played.frames[0].scan.time_offset.empty());
  EXPECT_TRUE(played.frames[1].color.empty());
  EXPECT_EQ(played.frames[1].mask(0, 0), 2);
  EXPECT_EQ(played.frames[1].scan.time_offset, std::vector{0.5F});
  const auto facts = played.source->describe();
  EXPECT_TRUE(any_has(facts, "images: 1 of 2 scans"));
  EXPECT_TRUE(any_has(facts, "masks: 1 of 2 scans"));
  EXPECT_TRUE(any_has(facts, "point times: 1 of 2 scans"));
}

TEST(KittiLidar, ReadsMasksOnlyWhenEnabled) {
  const TempFolder folder;
  write_scans_with_camera(folder);
  std::filesystem::create_directories(folder.path() / "masks");
  std::filesystem::create_directories(folder.path() / "other");
  write_png(folder.path() / "masks/0.png", Image<std::uint8_t>(kWidth, kHeight, 1));
  EXPECT_FALSE(open_dataset(folder.path(), {.masks = {}, .load_masks = false})->has_masks());
  expect_in("has no mask for any scan (masks are named as the scans, the first one 0.png)",
            message_of<DataError>([&] {
              open_dataset(folder.path(), {.masks = folder.path() / "other", .load_masks = true});
            }));
}

TEST(KittiLidar, IgnoresImagesWithoutCamera) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  write_color(folder.path() / "image_2/0.png");
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(played.frames.at(0).color.empty());
  EXPECT_TRUE(any_has(played.source->describe(), "images: not used"));
}

TEST(KittiLidar, SkipsFramesWithInconsistentFiles) {
  const TempFolder folder;
  write_scans_with_camera(folder);
  folder.write("point_times/0.bin", std::string(8, '\0'));
  std::filesystem::create_directories(folder.path() / "image_2");
  write_png(folder.path() / "image_2/1.png", Image<Rgb>(3, 3));
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.source->skipped(), 2U);
  EXPECT_TRUE(any_has(played.warnings, "has 2 times for 1 points"));
  EXPECT_TRUE(any_has(played.warnings, "is 3x3 pixels, the calibration has 8x6"));
}

TEST(KittiLidar, ReadsSharedScans) {
  const std::filesystem::path shared =
      std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/lidar/kitti00_6scans";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared data";
  const Playback played(open_dataset(shared));
  EXPECT_EQ(played.frames.size(), 6U);
  EXPECT_EQ(played.source->ground_truth().size(), 6U);
}

}  // namespace
}  // namespace mms
