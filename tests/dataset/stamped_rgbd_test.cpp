// RGB-D layouts whose images have stamps or poses: ARKitScenes, ScanNet++, EuRoC.
#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

// ---------------------------------------------------------------- ARKitScenes

void write_arkit(const TempFolder& folder) {
  for (const std::string stamp : {"305.377", "305.410", "1000.000"}) {
    write_color(folder.path() / "lowres_wide" / ("41069021_" + stamp + ".png"));
    write_depth(folder.path() / "lowres_depth" / ("41069021_" + stamp + ".png"));
    folder.write("lowres_wide_intrinsics/41069021_" + stamp + ".pincam", "8 6 10 11 4 3\n");
  }
  // A quarter turn about y; world-to-camera.
  folder.write("lowres_wide.traj", "305.377 0 0 0 0 0 0\n305.410 0 1.5707963267948966 0 1 0 0\n");
}

TEST(ArkitScenes, ReadsStampsCameraAndPoses) {
  const TempFolder folder;
  write_arkit(folder);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 3U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(305'377'000'000));
  EXPECT_EQ(played.frames[2].stamp, Timestamp(1000'000'000'000));  // not by name
  EXPECT_EQ(played.frames[0].depth(0, 0), 1.5F);
  EXPECT_EQ(played.frames[0].calibration->camera->fy, 11.0);
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 2U);
  // Camera at -R^T t, with R^T x = z for a quarter turn about y.
  EXPECT_TRUE(truth[1].T_world_sensor.translation().isApprox(Eigen::Vector3d(0.0, 0.0, -1.0), 1e-9))
      << truth[1].T_world_sensor.translation().transpose();
  EXPECT_TRUE(any_has(played.source->describe(), "layout: ARKitScenes"));
}

TEST(ArkitScenes, SaysWhatIsMissing) {
  const TempFolder folder;
  write_arkit(folder);
  std::filesystem::remove_all(folder.path() / "lowres_wide_intrinsics");
  expect_in("has no camera calibration",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
  std::filesystem::remove_all(folder.path() / "lowres_depth");
  std::filesystem::create_directories(folder.path() / "lowres_depth");
  expect_in("has 3 color images VIDEO_STAMP.png, 0 with depth",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

// ---------------------------------------------------------------- ScanNet++

/// Depth images of 8x6, color images of twice that size.
void write_scannetpp(const TempFolder& folder, const std::string& below = "") {
  std::string json;
  for (const std::string number : {"000000", "000010"}) {
    const auto base = folder.path() / below;
    std::filesystem::create_directories(base / "rgb");
    write_png(base / "rgb" / ("frame_" + number + ".png"), Image<Rgb>(2 * kWidth, 2 * kHeight));
    write_depth(base / "depth" / ("frame_" + number + ".png"), 2000);
    json += std::string(json.empty() ? "" : ",") + "\"frame_" + number +
            R"(": {"timestamp": 1.0, "intrinsic": [[20, 0, 7.5], [0, 22, 5.5], [0, 0, 1]],
                   "pose": [[1,0,0,)" +
            number + R"(], [0,1,0,0], [0,0,1,0], [0,0,0,1]]})";
  }
  const auto unpadded = [](std::string text) {  // JSON has no leading zeros
    for (const char* number : {"000000", "000010"}) {
      const std::string padded = std::string("0,") + number + "]";
      const std::size_t at = text.find(padded);
      text.replace(at, padded.size(), "0," + std::to_string(std::stoi(number)) + "]");
    }
    return text;
  };
  folder.write(below + (below.empty() ? "" : "/") + "pose_intrinsic_imu.json",
               "{" + unpadded(json) + "}");
}

TEST(ScanNetpp, ScalesCameraToDepthImages) {
  const TempFolder folder;
  write_scannetpp(folder);
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "frame_000000 frame_000010");
  const CameraIntrinsics& camera = *played.frames.at(0).calibration->camera;
  EXPECT_EQ(camera.fx, 10.0);
  EXPECT_EQ(camera.fy, 11.0);
  EXPECT_EQ(camera.cx, 3.5);  // (7.5 + 0.5) / 2 - 0.5
  EXPECT_EQ(camera.width, kWidth);
  EXPECT_EQ(played.frames[0].color.width(), kWidth);
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_EQ(played.source->ground_truth()[1].T_world_sensor.translation().x(), 10.0);
}

TEST(ScanNetpp, OpensSceneAndNamesMissingImages) {
  const TempFolder folder;
  write_scannetpp(folder, "iphone");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames.size(), 2U);
  std::filesystem::remove_all(folder.path() / "iphone/depth");
  expect_in("is a recording of ScanNet++ without its images in depth/",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

// ---------------------------------------------------------------- EuRoC

void write_euroc(const TempFolder& folder) {
  std::string list = "#timestamp [ns],filename\n";
  for (const std::string stamp : {"1403636579763555584", "1403636579813555456"}) {
    write_color(folder.path() / "mav0/cam0/data" / (stamp + ".png"));
    write_depth(folder.path() / "mav0/depth0/data" / (stamp + ".png"));
    list += stamp + "," + stamp + ".png\n";
  }
  folder.write("mav0/cam0/data.csv", list);
  folder.write("mav0/depth0/data.csv", list);
  folder.write("mav0/cam0/sensor.yaml",
               "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, 0.5,\n"
               "         0, 1, 0, 0,\n         0, 0, 1, 0,\n         0, 0, 0, 1]\n"
               "resolution: [8, 6]\ncamera_model: pinhole\nintrinsics: [10, 11, 4, 3]\n"
               "distortion_model: radial-tangential\n"
               "distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n");
  // A half turn about z: the camera is 0.5 m in the other direction.
  folder.write("mav0/state_groundtruth_estimate0/data.csv",
               "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z,v\n"
               "1403636579763555584,2,0,0,0,0,0,1,9,9,9\n");
}

TEST(Euroc, ReadsStampsCameraAndBodyPoses) {
  const TempFolder folder;
  write_euroc(folder);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1403636579763555584));
  EXPECT_EQ(played.frames[0].depth(0, 0), 1.5F);
  EXPECT_EQ(played.frames[0].calibration->camera->fy, 11.0);
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 1U);
  EXPECT_NEAR(truth[0].T_world_sensor.translation().x(), 1.5, 1e-12);
  EXPECT_TRUE(any_has(played.source->describe(), "layout: EuRoC with depth"));
}

TEST(Euroc, RegistersDepthOfCameraOfItsOwn) {
  const TempFolder folder;
  write_euroc(folder);
  const auto sensor = [&](const char* name, const char* shift) {
    folder.write(std::string(name) + "/sensor.yaml",
                 std::string("T_BS:\n  rows: 4\n  cols: 4\n  data: [1, 0, 0, ") + shift +
                     ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
                     "resolution: [8, 6]\nintrinsics: [10, 10, 4, 3]\n"
                     "distortion_model: radial-tangential\n"
                     "distortion_coefficients: [0, 0, 0, 0]\n");
  };
  sensor("mav0/cam0", "0.3");
  sensor("mav0/depth0", "0.3");
  EXPECT_FALSE(any_has(open_dataset(folder.path())->describe(), "registered"));
  sensor("mav0/depth0", "0.2");
  EXPECT_TRUE(any_has(open_dataset(folder.path())->describe(),
                      "depth: 8x6 pixels, registered to the color images"));
}

TEST(Euroc, NamesMissingDepth) {
  const TempFolder folder;
  write_euroc(folder);
  std::filesystem::remove_all(folder.path() / "mav0/depth0");
  expect_in("is in the layout of EuRoC, but depth0/data.csv is missing",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

// ---------------------------------------------------------------- since the start of a camera

constexpr std::int64_t kUptime = 5'000'000'000'000;  // [ns]; as milliseconds since 1970 in 2128

/// The frames are at 30 Hz.
void expect_frames_since_start(const std::filesystem::path& folder) {
  const Playback played(open_dataset(folder));
  ASSERT_EQ(played.frames.size(), 4U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(kUptime));
  EXPECT_EQ(played.frames[3].stamp, Timestamp(kUptime + 100'000'000));
  EXPECT_TRUE(played.warnings.empty());
}

std::string name_since_start(int frame) {
  return std::to_string(kUptime + 100'000'000 * frame / 3);
}

TEST(StampsSinceStart, AreReadFromLists) {
  const TempFolder folder;
  write_tum(folder, 4);
  for (const std::string image : {"rgb", "depth"}) {
    std::string list = "timestamp filename\n";
    for (int i = 0; i < 4; ++i) list += name_since_start(i) + " " + image + "/" + file_of(i) + "\n";
    folder.write(image + ".txt", "# " + list);
  }
  folder.write("groundtruth.txt", name_since_start(0) + " 0 0 0 0 0 0 1\n" + name_since_start(1) +
                                      " 0 0 0 0 0 0 1\n" + name_since_start(2) +
                                      " 0 0 0 0 0 0 1\n");
  expect_frames_since_start(folder.path());
  EXPECT_EQ(open_dataset(folder.path())->ground_truth()[0].stamp, Timestamp(kUptime));
}

TEST(StampsSinceStart, AreReadFromNames) {
  const TempFolder folder;
  for (int i = 0; i < 4; ++i) {
    write_color(folder.path() / "color" / (name_since_start(i) + ".png"));
    write_depth(folder.path() / "depth" / (name_since_start(i) + ".png"));
  }
  folder.write("calibration.yaml", kCalibration);
  expect_frames_since_start(folder.path());
}

TEST(StampsSinceStart, WarnsOfFramesFarApart) {
  const TempFolder folder;
  write_tum(folder, 5);
  for (const std::string image : {"rgb", "depth"}) {
    std::string list;  // microseconds since the start, which no one can tell from seconds
    for (int i = 0; i < 5; ++i) {
      list += std::to_string(5'000'000'000 + 33'333 * i) + " " + image + "/" + file_of(i) + "\n";
    }
    folder.write(image + ".txt", list);
  }
  const Playback played(open_dataset(folder.path()));
  EXPECT_TRUE(any_has(played.warnings, "the frames are 33333 s apart, for a map at most 10 s"));
  EXPECT_TRUE(any_has(played.source->describe(), "warning: the frames are 33333 s apart"));
}

}  // namespace
}  // namespace mms
