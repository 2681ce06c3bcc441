#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

const std::string kIdentity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
/// The camera of `kCalibration` as Open3D writes it, column by column.
const std::string kOpen3dCamera =
    R"({"width": 8, "height": 6, "intrinsic_matrix": [10, 0, 0, 0, 11, 0, 4, 3, 1]})";

std::string pose_at(double x) {
  return "1 0 0 " + std::to_string(x) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
}

// ---------------------------------------------------------------- ScanNet

/// Depth images of 8x6 and color images of twice that size, whose red value is their column.
void write_scannet(const TempFolder& folder, int count) {
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    Image<Rgb> color(2 * kWidth, 2 * kHeight);
    for (int y = 0; y < color.height(); ++y) {
      for (int x = 0; x < color.width(); ++x) color(x, y) = {static_cast<std::uint8_t>(x), 0, 0};
    }
    std::filesystem::create_directories(folder.path() / "color");
    write_png(folder.path() / "color" / (name + ".png"), color);
    write_depth(folder.path() / "depth" / (name + ".png"), 2500);
    folder.write("pose/" + name + ".txt", i == 1 ? "-inf -inf -inf -inf\n" : pose_at(i));
  }
  folder.write("intrinsic/intrinsic_depth.txt", "10 0 4 0\n0 10 3 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("intrinsic/intrinsic_color.txt", "20 0 8 0\n0 20 6 0\n0 0 1 0\n0 0 0 1\n");
}

TEST(ScanNet, ReadsFramesInTheOrderOfNumbers) {
  const TempFolder folder;
  write_scannet(folder, 11);
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "0 1 2 3 4 5 6 7 8 9 10");
  EXPECT_EQ(played.frames[10].stamp, Timestamp(333'333'333));
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.5F);
  EXPECT_TRUE(any_has(played.source->describe(), "layout: ScanNet"));
}

TEST(ScanNet, SamplesColorsForDepthCamera) {
  const TempFolder folder;
  write_scannet(folder, 1);
  const Frame frame = Playback(open_dataset(folder.path())).frames.at(0);
  ASSERT_EQ(frame.color.width(), kWidth);
  ASSERT_EQ(frame.color.height(), kHeight);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(frame.color(x, 2).r, 2 * x);
  EXPECT_EQ(frame.calibration->camera->fx, 10.0);
}

TEST(ScanNet, TakesIntrinsicsOfDepthImages) {
  const TempFolder folder;
  write_scannet(folder, 1);
  const Playback played(open_dataset(folder.path(), {.camera = {.intrinsics = {{12, 12, 4, 3}}}}));
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].calibration->camera->fx, 12.0);
}

TEST(ScanNet, SkipsUnknownPoses) {
  const TempFolder folder;
  write_scannet(folder, 3);
  const Playback played(open_dataset(folder.path()));
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[1].stamp, played.frames[2].stamp);
  EXPECT_EQ(truth[1].T_world_sensor.translation().x(), 2.0);
  EXPECT_TRUE(any_has(played.warnings, "pose skipped: "));
}

TEST(ScanNet, ErrorNamesDamagedCamera) {
  const TempFolder folder;
  write_scannet(folder, 1);
  folder.write("intrinsic/intrinsic_depth.txt", "10 0 4\n");
  expect_in("intrinsic_depth.txt: has 3 numbers (expected a 3x3 or 4x4 camera matrix)",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

// ---------------------------------------------------------------- Replica

void write_replica(const TempFolder& folder, int count) {
  std::string poses;
  for (int i = 0; i < count; ++i) {
    const std::string name = "00000" + std::to_string(i);
    write_color(folder.path() / "room0/results" / ("frame" + name + ".png"));
    write_depth(folder.path() / "room0/results" / ("depth" + name + ".png"), 13107);
    poses += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0 0 0 0 1\n";
  }
  folder.write("room0/traj.txt", poses);
  folder.write(
      "cam_params.json",
      R"({"camera": {"w": 8, "h": 6, "fx": 10, "fy": 10, "cx": 4, "cy": 3, "scale": 6553.5}})");
}

TEST(Replica, ReadsFramesPosesAndCameraOfParentFolder) {
  const TempFolder folder;
  write_replica(folder, 3);
  const Playback played(open_dataset(folder.path() / "room0"));
  EXPECT_EQ(played.names(), "frame000000 frame000001 frame000002");
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  ASSERT_EQ(played.source->ground_truth().size(), 3U);
  EXPECT_EQ(played.source->ground_truth()[2].T_world_sensor.translation().x(), 2.0);
  EXPECT_EQ(played.source->ground_truth()[2].stamp, played.frames[2].stamp);
}

TEST(Replica, HasDefaultCamera) {
  const TempFolder folder;
  write_replica(folder, 1);
  std::filesystem::remove(folder.path() / "cam_params.json");
  EXPECT_TRUE(any_has(open_dataset(folder.path() / "room0")->describe(), "1200x680"));
}

TEST(Replica, ErrorNamesKeyOfDamagedCamera) {
  const TempFolder folder;
  write_replica(folder, 1);
  folder.write("cam_params.json", R"({"camera": {"w": 8, "h": 6, "fx": -1}})");
  expect_in("camera.fx", message_of<DataError>([&] { open_dataset(folder.path() / "room0"); }));
}

// ---------------------------------------------------------------- Open3D, Redwood

void write_open3d(const TempFolder& folder, const std::string& colors, int count,
                  const std::string& depths = "depth") {
  for (int i = 0; i < count; ++i) {
    const std::string name = "0000" + std::to_string(i) + ".png";
    write_color(folder.path() / colors / name);
    write_depth(folder.path() / depths / name, 1500);
  }
}

TEST(Open3d, ReadsFramesCameraAndPoses) {
  for (const char* colors : {"color", "image", "rgb"}) {
    const TempFolder folder;
    write_open3d(folder, colors, 2);
    folder.write("camera_intrinsic.json", kOpen3dCamera);
    folder.write("trajectory.log", "0 0 1\n" + kIdentity + "1 1 2\n" + pose_at(0.25));
    const Playback played(open_dataset(folder.path()));
    ASSERT_EQ(played.names(), "00000 00001");
    EXPECT_EQ(played.frames[0].depth(0, 0), 1.5F);
    EXPECT_EQ(played.frames[0].calibration->camera->fy, 11.0);
    EXPECT_EQ(played.frames[0].calibration->camera->cx, 4.0);
    ASSERT_EQ(played.source->ground_truth().size(), 2U);
    EXPECT_EQ(played.source->ground_truth()[1].T_world_sensor.translation().x(), 0.25);
    EXPECT_EQ(played.source->ground_truth()[1].stamp, played.frames[1].stamp);
  }
}

TEST(Open3d, TakesFoldersOfSimilarNames) {
  constexpr std::pair<const char*, const char*> kFolders[] = {
      {"images", "depth"}, {"rgb", "depths"}, {"RGB", "Depth"}, {"rgb_0", "depth_0"}};
  for (const auto& [colors, depths] : kFolders) {
    const TempFolder folder;
    write_open3d(folder, colors, 2, depths);
    folder.write("camera_intrinsic.json", kOpen3dCamera);
    const Playback played(open_dataset(folder.path()));
    EXPECT_EQ(played.names(), "00000 00001") << colors;
    EXPECT_EQ(played.frames[0].depth(0, 0), 1.5F) << depths;
  }
}

TEST(Open3d, LeavesFoldersWithAListToIt) {
  for (const char* list : {"associations.txt", "assoc.txt"}) {
    const TempFolder folder;
    write_open3d(folder, "images", 2);
    folder.write("calibration.yaml", kCalibration);
    folder.write(list, "1.5 images/00001.png 1.5 depth/00001.png\n");
    const Playback played(open_dataset(folder.path()));
    ASSERT_EQ(played.frames.size(), 1U) << list;
    EXPECT_EQ(played.frames[0].stamp, Timestamp(1'500'000'000));
  }
}

TEST(Open3d, TakesStampsFromNames) {
  const TempFolder folder;
  for (const char* name : {"1305031102175304000.png", "1305031102208304000.png"}) {
    write_color(folder.path() / "color" / name);
    write_depth(folder.path() / "depth" / name);
  }
  folder.write("camera_intrinsic.json", kOpen3dCamera);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[0].stamp, Timestamp(1'305'031'102'175'304'000));
  EXPECT_TRUE(any_has(played.source->describe(), "stamps: names of the images"));
  write_color(folder.path() / "color/99999999999.png");
  write_depth(folder.path() / "depth/99999999999.png");
  expect_in("99999999999.png: has a number that is too large",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(Open3d, ReadsCameraOfRecorders) {
  const TempFolder folder;
  write_open3d(folder, "color", 1);
  folder.write("intrinsic.json", R"({"width": 8, "height": 6, "depth_scale": 500, "fps": 30,
    "intrinsic_matrix": [10, 0, 0, 0, 10, 0, 4, 3, 1]})");
  EXPECT_EQ(Playback(open_dataset(folder.path())).frames.at(0).depth(0, 0), 3.0F);
}

TEST(Open3d, DoesNotGuessCameraOfOtherSizes) {
  const TempFolder folder;
  write_open3d(folder, "color", 1);
  expect_in("has no camera calibration (add calibration.yaml",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
  const TempFolder large;
  std::filesystem::create_directories(large.path() / "color");
  write_png(large.path() / "color/0.png", Image<Rgb>(640, 480));
  write_depth(large.path() / "depth/0.png");
  EXPECT_TRUE(any_has(open_dataset(large.path())->describe(), "PrimeSense camera (525 px)"));
}

TEST(Open3d, SamplesColorsForDepthOfArkit) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "images");
  std::filesystem::create_directories(folder.path() / "depth");
  write_png(folder.path() / "images/0.png", Image<Rgb>(512, 384));
  write_png(folder.path() / "depth/0.png", Image<std::uint16_t>(256, 192, 1500));
  folder.write("calibration.yaml",
               "fx: 400\nfy: 400\ncx: 255.5\ncy: 191.5\nwidth: 512\nheight: 384\n"
               "depth_scale: 1000\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.frames.size(), 1U);
  const Frame& frame = played.frames[0];
  EXPECT_EQ(*frame.calibration->camera, (CameraIntrinsics{200, 200, 127.5, 95.5, 256, 192, {}}));
  EXPECT_EQ(frame.color.width(), 256);
  EXPECT_EQ(frame.depth(0, 0), 1.5F);
  // Depth of other cameras may be unregistered where its size is another.
  write_png(folder.path() / "depth/0.png", Image<std::uint16_t>(128, 96, 1500));
  EXPECT_TRUE(Playback(open_dataset(folder.path())).frames.empty());
}

TEST(Open3d, ErrorNamesFoldersWithoutCommonNumber) {
  const TempFolder folder;
  write_color(folder.path() / "color/0.png");
  write_depth(folder.path() / "depth/1.png");
  expect_in("has 1 color images color/N.png and 1 depth images depth/N.png, and no number N",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(Open3d, ErrorNamesLineOfDamagedPose) {
  const TempFolder folder;
  write_open3d(folder, "color", 1);
  folder.write("camera_intrinsic.json", kOpen3dCamera);
  folder.write("trajectory.log", "0 0\n" + kIdentity);
  expect_in("trajectory.log:1: is not the head of a pose",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

// ---------------------------------------------------------------- TartanAir

std::string npy(const std::string& type, int width, int height, const std::string& data) {
  std::string head = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(height) + ", " + std::to_string(width) + "), }\n";
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  bytes += static_cast<char>(head.size());
  bytes += '\0';
  return bytes + head + data;
}

std::string floats(std::size_t count, float value) {
  std::string data(count * sizeof value, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(data.data() + i * sizeof value, &value, sizeof value);
  }
  return data;
}

TEST(TartanAir, ReadsDepthInMetersAndPosesWithAxesForwardRightDown) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "image_left");
  for (const char* name : {"000000", "000001"}) {
    write_png(folder.path() / "image_left" / (std::string(name) + "_left.png"),
              Image<Rgb>(640, 480));
    folder.write(std::string("depth_left/") + name + "_left_depth.npy",
                 npy("<f4", 640, 480, floats(640 * 480, 3.25F)));
  }
  // 1 m forward, 2 m right, 3 m down; then turned right by 90 degrees.
  folder.write("pose_left.txt", "0 0 0 0 0 0 1\n1 2 3 0 0 0.70710678 0.70710678\n");
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "000000_left 000001_left");
  EXPECT_EQ(played.frames[0].depth(5, 7), 3.25F);
  const Trajectory& truth = played.source->ground_truth();
  ASSERT_EQ(truth.size(), 2U);
  const Eigen::Isometry3d step =
      truth[0].T_world_sensor.isometry().inverse() * truth[1].T_world_sensor.isometry();
  EXPECT_TRUE(step.translation().isApprox(Eigen::Vector3d(2, 3, 1), 1e-6));
  // Forward, z, then shows to the former right, x.
  EXPECT_TRUE((step.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-6));
}

TEST(TartanAir, SkipsFramesWithDamagedDepth) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "image_left");
  write_png(folder.path() / "image_left/000000_left.png", Image<Rgb>(640, 480));
  folder.write("depth_left/000000_left_depth.npy", npy("<f4", 640, 480, "short"));
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.source->skipped(), 1U);
  EXPECT_TRUE(any_has(played.warnings, "000000_left_depth.npy: has 5 bytes of data"));
}

TEST(NumberedImages, DepthScaleHoldsForFloatsToo) {
  const TempFolder folder;
  write_color(folder.path() / "rgb/0.png");
  folder.write("depth/0.npy", npy("<f4", kWidth, kHeight, floats(kWidth * kHeight, 1500.0F)));
  const SourceOptions options{.camera = {.intrinsics = {{10, 10, 4, 3}}, .depth_scale = 1000.0}};
  EXPECT_EQ(Playback(open_dataset(folder.path(), options)).frames.at(0).depth(0, 0), 1.5F);
}

}  // namespace
}  // namespace mms
