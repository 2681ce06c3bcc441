#include "mms/dataset/lidar/lidar_scans.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

const std::string kPoint(16, '\0');

TEST(LidarScans, ReadsScansAndPoses) {
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

TEST(LidarScans, TransformsPosesToLidar) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("poses.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n");
  folder.write("calibration.yaml", "T_camera_lidar: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const auto source = open_dataset(folder.path());
  EXPECT_EQ(source->ground_truth()[0].T_world_sensor.translation().x(), 7.5);
}

TEST(LidarScans, ReadsPosesInTheFormatOfTum) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("poses.txt", "0.0 7 0 0 0 0 0 1\n");
  folder.write("calibration.yaml", "T_camera_lidar: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const auto source = open_dataset(folder.path());
  ASSERT_EQ(source->ground_truth().size(), 1U);
  EXPECT_EQ(source->ground_truth()[0].T_world_sensor.translation().x(), 7.0);
}

TEST(LidarScans, ReadsStampsFromTimes) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  folder.write("velodyne/1.bin", kPoint);
  folder.write("times.txt", "3.5e+00\n3.6\n");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames[0].stamp, Timestamp(3'500'000'000));
  folder.write("times.txt", "3.5\n");
  expect_in("has 1 stamps for 2 scans",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(LidarScans, ReadsStampsSinceTheStartOfTheSensor) {
  const TempFolder names;
  const TempFolder times;
  std::string lines;
  for (const std::string stamp : {"5000000000000", "5000100000000", "5000200000000"}) {
    names.write(stamp + ".bin", kPoint);
    times.write("velodyne/" + stamp.substr(4, 1) + ".bin", kPoint);
    lines += stamp + "\n";
  }
  times.write("times.txt", lines);
  for (const auto& folder : {names.path(), times.path()}) {
    const Playback played(open_dataset(folder));
    ASSERT_EQ(played.frames.size(), 3U);
    EXPECT_EQ(played.frames[0].stamp, Timestamp(5'000'000'000'000));
    EXPECT_EQ(played.frames[2].stamp, Timestamp(5'000'200'000'000));
  }
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

TEST(LidarScans, RecognizesNumbersOfAPoint) {
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

TEST(LidarScans, ReadsNuScenes) {
  const TempFolder folder;
  folder.write("n008__LIDAR_TOP__1532402927647951.pcd.bin", ring_of_points({30, 7}));
  folder.write("n008__LIDAR_TOP__1532402927697951.pcd.bin", ring_of_points({30, 7}));
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].scan.points.size(), 720U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'532'402'927'647'951'000));
  EXPECT_EQ(played.frames[1].stamp - played.frames[0].stamp, std::chrono::milliseconds(50));
}

/// x of the step between two poses of the ground truth, and the others.
Eigen::Isometry3d truth_step(const FrameSource& source) {
  const Trajectory& truth = source.ground_truth();
  return truth.at(0).T_world_sensor.isometry().inverse() * truth.at(1).T_world_sensor.isometry();
}

TEST(LidarScans, ReadsKittiRaw) {
  const TempFolder folder;
  const std::string drive = "2011_09_26/drive/";
  for (const char* scan : {"0000000000", "0000000002"}) {
    folder.write(drive + "velodyne_points/data/" + scan + ".bin", kPoint);
  }
  folder.write(drive + "velodyne_points/timestamps.txt",
               "2011-09-26 13:02:25.500000000\n2011-09-26 13:02:25.600000000\n"
               "2011-09-26 13:02:25.700000001\n");
  // One degree of longitude at the equator has 111,319.49 m.
  folder.write(drive + "oxts/data/0000000000.txt", "0 10 5 0 0 0 1 2 3\n");
  folder.write(drive + "oxts/data/0000000002.txt", "0 10.00001 5.5 0 0 0 1 2 3\n");
  folder.write("2011_09_26/calib_imu_to_velo.txt",
               "calib_time: x\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
  const Playback played(open_dataset(folder.path() / drive));
  ASSERT_EQ(played.names(), "0000000000 0000000002");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'317'042'145'500'000'000));
  EXPECT_EQ(played.frames[1].stamp, Timestamp(1'317'042'145'700'000'001));
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_TRUE(truth_step(*played.source)
                  .translation()
                  .isApprox(Eigen::Vector3d(1.1131949, 0.0, 0.5), 1e-6));
}

/// The lines of missing scans are empty there.
TEST(LidarScans, ReadsKittiRawWithEmptyLinesOfMissingScans) {
  const TempFolder folder;
  for (const char* scan : {"0000000000", "0000000003"}) {
    folder.write(std::string("velodyne_points/data/") + scan + ".bin", kPoint);
  }
  folder.write("velodyne_points/timestamps.txt",
               "2011-09-26 13:02:25.500000000\n\n\n2011-09-26 13:02:25.800000000\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "0000000000 0000000003");
  EXPECT_EQ(played.frames[1].stamp, Timestamp(1'317'042'145'800'000'000));
  folder.write("velodyne_points/data/0000000002.bin", kPoint);
  expect_in("has no line for scan 0000000002.bin",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(LidarScans, ReadsMulRan) {
  const TempFolder folder;
  folder.write("Ouster/1564718964000000000.bin", ring_of_points({30}));
  folder.write("Ouster/1564718964100000000.bin", ring_of_points({30}));
  // The vehicle drives 2 m forward; the LiDAR on it looks backward.
  folder.write("global_pose.csv",
               "1564718964000000000,1,0,0,5,0,1,0,6,0,0,1,7\n"
               "1564718964100000000,1,0,0,7,0,1,0,6,0,0,1,7\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'564'718'964'000'000'000));
  EXPECT_EQ(played.frames[0].scan.points.size(), 720U);
  EXPECT_NEAR(truth_step(*played.source).translation().x(), -2.0, 1e-3);
  EXPECT_EQ(played.source->ground_truth()[1].stamp, played.frames[1].stamp);
}

TEST(LidarScans, ReadsMulRanAsArrangedForItsPlayer) {
  const TempFolder folder;
  folder.write("sensor_data/Ouster/1564718964000000000.bin", ring_of_points({30}));
  folder.write("global_pose.csv", "1564718964000000000,1,0,0,5,0,1,0,6,0,0,1,7\n");
  EXPECT_EQ(open_dataset(folder.path())->ground_truth().size(), 1U);
}

TEST(LidarScans, ReadsNclt) {
  const TempFolder folder;
  const std::string day = "2012-01-08/";
  // 1 m, 2 m, 3 m; z is down.
  const std::uint16_t coordinates[] = {20200, 20400, 20600};
  const std::string record =
      std::string(reinterpret_cast<const char*>(coordinates), sizeof coordinates) + "\x07\x01";
  folder.write(day + "velodyne_sync/1326030975726043.bin", record);
  folder.write(day + "velodyne_sync/1326030975926043.bin", record);
  folder.write("ground_truth/groundtruth_2012-01-08.csv",
               "1326030975726043, nan, nan, nan, nan, nan, nan\n"
               "1326030975826043, 1, 2, 3, 0, 0, 0\n1326030975926043, 1, 2, 4, 0, 0, 0\n");
  const Playback played(open_dataset(folder.path() / day));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'326'030'975'726'043'000));
  EXPECT_TRUE(played.frames[0].scan.points[0].isApprox(Eigen::Vector3f(1, -2, -3), 1e-4F));
  EXPECT_EQ(played.frames[0].scan.intensity[0], 7.0F);
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_TRUE(truth_step(*played.source).translation().isApprox(Eigen::Vector3d(0, 0, -1), 1e-9));
}

/// A cloud of the size of an Ouster scan, in the order of its columns.
PointCloudFile ouster_cloud() {
  PointCloudFile cloud;
  for (int i = 0; i < 64 * 1024; ++i) {
    cloud.points.emplace_back(1.0F + 1e-4F * static_cast<float>(i), 2.0F, 3.0F);
  }
  return cloud;
}

TEST(LidarScans, ReadsNewerCollege) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "raw_format/ouster_scan");
  for (const char* name : {"cloud_1583836591_182590976", "cloud_1583836591_282590976"}) {
    write_pcd(folder.path() / "raw_format/ouster_scan" / (std::string(name) + ".pcd"),
              ouster_cloud());
  }
  folder.write("ground_truth/registered_poses.csv",
               "#sec,nsec,x,y,z,qx,qy,qz,qw\n1583836591,182590976,0,0,0,0,0,0,1\n"
               "1583836591,282590976,0,0,1.5,0,0,0,1\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'583'836'591'182'590'976));
  const LidarScan& scan = played.frames[0].scan;
  ASSERT_EQ(scan.time_offset.size(), scan.points.size());
  EXPECT_EQ(scan.time_offset[63], 0.0F);
  EXPECT_NEAR(scan.time_offset.back(), 0.1F * 1023.0F / 1024.0F, 1e-6F);
  EXPECT_TRUE(truth_step(*played.source).translation().isApprox(Eigen::Vector3d(0, 0, 1.5), 1e-9));
}

/// A record of x y z, further bytes, and the time of the point.
template <class Time>
std::string helipr_record(std::size_t bytes, std::size_t time_at, Time time) {
  const float xyz[] = {1.0F, 2.0F, 3.0F};
  std::string record(bytes, '\0');
  std::memcpy(record.data(), xyz, sizeof xyz);
  std::memcpy(record.data() + time_at, &time, sizeof time);
  return record;
}

TEST(LidarScans, ReadsSensorsOfHeLiPR) {
  constexpr std::uint32_t kNanoseconds = 50'000'000;
  const std::pair<std::string, std::string> sensors[] = {
      {"Ouster", helipr_record(26, 16, kNanoseconds)},
      {"Velodyne", helipr_record(22, 18, 0.05F)},
      {"Avia", helipr_record(19, 15, kNanoseconds)},
      {"Aeva", helipr_record(29, 20, kNanoseconds)}};
  for (const auto& [sensor, record] : sensors) {
    const TempFolder folder;
    folder.write("LiDAR/" + sensor + "/1691936558000000000.bin", record + record);
    folder.write("LiDAR/" + sensor + "/1691936558100000000.bin", record);
    folder.write("LiDAR_GT/global_" + sensor + "_gt.txt",
                 "1691936558000000000 1 2 3 0 0 0 1\n1691936558100000000 1.5 2 3 0 0 0 1\n");
    const Playback played(open_dataset(folder.path() / "LiDAR" / sensor));
    ASSERT_EQ(played.frames.size(), 2U) << sensor;
    const LidarScan& scan = played.frames[0].scan;
    ASSERT_EQ(scan.points.size(), 2U) << sensor;
    EXPECT_EQ(scan.points[1], Eigen::Vector3f(1, 2, 3)) << sensor;
    EXPECT_NEAR(scan.time_offset.at(1), 0.05F, 1e-6F) << sensor;
    EXPECT_NEAR(truth_step(*played.source).translation().x(), 0.5, 1e-9) << sensor;
  }
}

/// Its records must not be read as those of MulRan, which has the same folder.
TEST(LidarScans, ReadsOusterOfHeLiPRFromTheFolderAbove) {
  const TempFolder folder;
  std::string records;
  for (int i = 0; i < 8; ++i) records += helipr_record(26, 16, std::uint32_t{0});
  folder.write("LiDAR/Ouster/1689519062000000000.bin", records);
  folder.write("LiDAR_GT/global_Ouster_gt.txt", "1689519062000000000 1 2 3 0 0 0 1\n");
  const Playback played(open_dataset(folder.path() / "LiDAR"));
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].scan.points.size(), 8U);
  EXPECT_EQ(played.source->ground_truth().size(), 1U);
}

TEST(LidarScans, ReadsShorterRecordsOfEarlierAeva) {
  const TempFolder folder;
  const std::string record = helipr_record(25, 20, std::uint32_t{50'000'000});
  folder.write("LiDAR/Aeva/1689519062000000000.bin", record + record + record);
  const Playback early(open_dataset(folder.path() / "LiDAR/Aeva"));
  ASSERT_EQ(early.frames.size(), 1U);
  EXPECT_EQ(early.frames[0].scan.points.size(), 3U);
  EXPECT_NEAR(early.frames[0].scan.time_offset.at(2), 0.05F, 1e-6F);
}

TEST(LidarScans, SkipsScansWithTimesThatAreNone) {
  const TempFolder folder;
  folder.write("LiDAR/Velodyne/1.bin", helipr_record(22, 18, std::nanf("")));
  folder.write("LiDAR/Velodyne/2.bin", helipr_record(22, 18, 0.05F));
  const Playback records(open_dataset(folder.path() / "LiDAR/Velodyne"));
  EXPECT_EQ(records.names(), "2");
  EXPECT_TRUE(any_has(records.warnings, "the time of point 0 is not within 1 s"));

  PointCloudFile cloud;
  std::filesystem::create_directory(folder.path() / "clouds");
  cloud.points.resize(2, Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  for (const float last : {0.1F, 2.0F}) {  // [s]
    cloud.time_offsets = {0.0F, last};
    write_pcd(folder.path() / "clouds" / (last < 1.0F ? "000000.pcd" : "000001.pcd"), cloud);
  }
  const Playback clouds(open_dataset(folder.path() / "clouds"));
  EXPECT_EQ(clouds.names(), "000000");
  EXPECT_TRUE(any_has(clouds.warnings, "the time of point 1 is not within 1 s"));
}

TEST(LidarScans, SortsByNumbersOfDifferentLength) {
  const TempFolder folder;
  PointCloudFile cloud;
  cloud.points.emplace_back(1.0F, 2.0F, 3.0F);
  for (const char* name :
       {"cloud_1583836591_82590976", "cloud_1583836591_182590976", "cloud_1583836592_2590976"}) {
    write_pcd(folder.path() / (std::string(name) + ".pcd"), cloud);
  }
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(),
            "cloud_1583836591_82590976 cloud_1583836591_182590976 cloud_1583836592_2590976");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'583'836'591'082'590'976));
  folder.write("padded/0000000000000001.bin", kPoint);
  EXPECT_EQ(Playback(open_dataset(folder.path() / "padded")).frames.at(0).stamp, Timestamp())
      << "a number, not a stamp";
}

TEST(LidarScans, DoesWithoutTruthOfKittiRawIfACalibrationIsMissing) {
  const TempFolder folder;
  folder.write("drive/velodyne_points/data/0000000000.bin", kPoint);
  folder.write("drive/oxts/data/0000000000.txt", "0 10 5 0 0 0\n");
  const auto source = open_dataset(folder.path() / "drive");
  EXPECT_TRUE(source->ground_truth().empty());
  EXPECT_TRUE(any_has(source->describe(), "oxts/ not used"));
}

TEST(LidarScans, ReadsPcdAndPlyFilesWithNumbersAlone) {
  const TempFolder folder;
  PointCloudFile cloud;
  cloud.points.emplace_back(1.0F, 2.0F, 3.0F);
  cloud.intensities = {0.5F};
  cloud.time_offsets = {0.02F};
  write_pcd(folder.path() / "000000.pcd", cloud);
  write_pcd(folder.path() / "000001.pcd", cloud);
  write_pcd(folder.path() / "static_map.pcd", cloud);
  folder.write("groundtruth.txt", "0 0 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "000000 000001");
  EXPECT_EQ(played.frames[1].stamp, Timestamp(100'000'000));
  EXPECT_EQ(played.frames[1].scan.intensity, cloud.intensities);
  EXPECT_EQ(played.frames[1].scan.time_offset, cloud.time_offsets);
  EXPECT_EQ(truth_step(*played.source).translation().x(), 1.0);
  const TempFolder result;
  write_ply(result.path() / "static_map.ply", cloud);
  expect_in("no recording found", message_of<DataError>([&] { open_dataset(result.path()); }));
  write_ply(result.path() / "7.ply", cloud);
  EXPECT_EQ(Playback(open_dataset(result.path())).names(), "7");
}

/// The layout of the odometry benchmark: poses of camera 0, images of camera 2.
TEST(LidarScans, ReadsOdometryBenchmark) {
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
  const std::string error = message_of<DataError>([&] { open_dataset(folder.path() / sequence); });
  expect_in("calib.txt: has no line 'Tr:'", error);
  expect_in("data_odometry_calib.zip", error);
}

/// Stamps and poses are those of the scans' numbers.
TEST(LidarScans, ReadsPartOfASequence) {
  const TempFolder folder;
  folder.write("velodyne/000001.bin", kPoint);
  folder.write("velodyne/000003.bin", kPoint);
  folder.write("times.txt", "0.0\n0.11\n0.2\n0.33\n0.4\n");
  folder.write("poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n"
               "1 0 0 3 0 1 0 0 0 0 1 0\n1 0 0 4 0 1 0 0 0 0 1 0\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "000001 000003");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(110'000'000));
  EXPECT_EQ(played.frames[1].stamp, Timestamp(330'000'000));
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[0].stamp, played.frames[0].stamp);
  EXPECT_EQ(truth[0].T_world_sensor.translation().x(), 1.0);
  EXPECT_EQ(truth[1].T_world_sensor.translation().x(), 3.0);
}

TEST(LidarScans, SkipsEmptyAndTruncatedScans) {
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

TEST(LidarScans, ReadsImagesMasksAndPointTimes) {
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
  EXPECT_TRUE(any_has(played.warnings, "has no T_camera_lidar"));
}

TEST(LidarScans, ReadsMasksOnlyWhenEnabled) {
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

TEST(LidarScans, IgnoresImagesWithoutCamera) {
  const TempFolder folder;
  folder.write("velodyne/0.bin", kPoint);
  write_color(folder.path() / "image_2/0.png");
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(played.frames.at(0).color.empty());
  EXPECT_TRUE(any_has(played.source->describe(), "images: not used"));
}

TEST(LidarScans, SkipsFramesWithInconsistentFiles) {
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

TEST(LidarScans, ReadsSharedScans) {
  const std::filesystem::path shared =
      std::filesystem::path(MMS_SOURCE_DIR) / "../shared/data/lidar/kitti00_6scans";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared data";
  const Playback played(open_dataset(shared));
  EXPECT_EQ(played.frames.size(), 6U);
  EXPECT_EQ(played.source->ground_truth().size(), 6U);
}

TEST(LidarScans, ReadsSecondsWithDecimalsInNames) {
  const TempFolder folder;
  for (const char* name :
       {"1710252326.122305000", "1710252326.922305000", "1710252327.022305000"}) {
    folder.write(std::string(name) + ".bin", kPoint);
  }
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 3U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'710'252'326'122'305'000));
  EXPECT_EQ(played.frames[2].stamp, Timestamp(1'710'252'327'022'305'000));
  EXPECT_TRUE(any_has(played.source->describe(), "stamps: names of the scans"));
  const TempFolder other;
  other.write("scan.1532402927647951.bin", kPoint);
  EXPECT_EQ(Playback(open_dataset(other.path())).frames.at(0).stamp,
            Timestamp(1'532'402'927'647'951'000));
}

}  // namespace
}  // namespace mms
