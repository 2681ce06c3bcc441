#include "mms/dataset/folder/folder_rgbd.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

void write_frame(const TempFolder& folder, const std::string& name, std::uint16_t depth) {
  write_color(folder.path() / (name + ".color.png"));
  write_depth(folder.path() / (name + ".depth.png"), depth);
  folder.write(name + ".pose.txt", "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
}

TEST(FolderRgbd, ReadsFramesAndPoses) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  write_frame(folder, "frame-000000", 2000);
  write_frame(folder, "frame-000001", 65535);
  const Playback played(open_dataset(folder.path()));
  ASSERT_EQ(played.names(), "frame-000000 frame-000001");
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  EXPECT_EQ(played.frames[1].depth(0, 0), 0.0F);
  EXPECT_EQ(played.frames[1].stamp, Timestamp(33'333'333));
  ASSERT_EQ(played.source->ground_truth().size(), 2U);
  EXPECT_EQ(played.source->ground_truth()[1].stamp, played.frames[1].stamp);
  EXPECT_EQ(played.source->ground_truth()[1].T_world_sensor.translation().x(), 0.5);
}

TEST(FolderRgbd, UsesSevenScenesCameraByDefault) {
  const TempFolder folder;
  write_frame(folder, "frame-000000", 2000);
  const auto lines = open_dataset(folder.path())->describe();
  EXPECT_TRUE(any_has(lines, "default of 7-Scenes"));
  EXPECT_TRUE(any_has(lines, "640x480"));
}

TEST(FolderRgbd, ReadsCameraMatrixOfFolderAbove) {
  const TempFolder folder;
  folder.write("camera-intrinsics.txt", " 1.0e+01 0 4.0\n 0 1.2e+01 3.0\n 0 0 1\n");
  std::filesystem::create_directories(folder.path() / "seq-01");
  write_color(folder.path() / "seq-01/frame-000000.color.png");
  write_depth(folder.path() / "seq-01/frame-000000.depth.png", 2000);
  const Playback played(open_dataset(folder.path() / "seq-01"));
  ASSERT_EQ(played.frames.size(), 1U);
  const CameraIntrinsics camera{10.0, 12.0, 4.0, 3.0, kWidth, kHeight, {}};
  EXPECT_EQ(played.frames[0].calibration->camera, camera);
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  EXPECT_TRUE(any_has(played.source->describe(), "calibration: camera-intrinsics.txt"));
}

const std::string kDepthInfo =
    "m_versionNumber = 4\nm_sensorName = phone\nm_depthWidth = 8\nm_depthHeight = 6\n"
    "m_depthShift = 500\n"
    "m_calibrationDepthIntrinsic = 10 0 4 0 0 10 3 0 0 0 1 0 0 0 0 1 \n"
    "m_calibrationDepthExtrinsic = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 \n";

/// A depth image of 8x6 and a color image of twice that size, whose red value is its column.
void write_phone_frame(const TempFolder& folder) {
  Image<Rgb> color(2 * kWidth, 2 * kHeight);
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x < color.width(); ++x) color(x, y) = {static_cast<std::uint8_t>(x), 0, 0};
  }
  write_png(folder.path() / "frame-000000.color.png", color);
  std::string pgm = "P5\n8 6\n65535\n";
  for (int i = 0; i < kWidth * kHeight; ++i) pgm += {'\x03', '\xE8'};  // 1000, high byte first
  folder.write("frame-000000.depth.pgm", pgm);
}

TEST(FolderRgbd, ReadsSensorInfoOfBothCameras) {
  const TempFolder folder;
  write_phone_frame(folder);
  folder.write("_info.txt", kDepthInfo +
                                "m_colorWidth = 16\nm_colorHeight = 12\n"
                                "m_calibrationColorIntrinsic = 20 0 8 0 0 20 6 0 0 0 1 0 0 0 0 1\n"
                                "m_calibrationColorExtrinsic = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.warnings, std::vector<std::string>{});
  ASSERT_EQ(played.frames.size(), 1U);
  EXPECT_EQ(played.frames[0].calibration->camera->fx, 10.0);
  EXPECT_EQ(played.frames[0].depth(0, 0), 2.0F);
  ASSERT_EQ(played.frames[0].color.width(), kWidth);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(played.frames[0].color(x, 2).r, 2 * x);
}

TEST(FolderRgbd, WarnsOfExtrinsicsInSensorInfo) {
  const TempFolder folder;
  write_frame(folder, "frame-000000", 1000);
  folder.write("info.txt", kDepthInfo +
                               "m_colorWidth = 8\nm_colorHeight = 6\n"
                               "m_calibrationColorIntrinsic = 10 0 4 0 0 10 3 0 0 0 1 0 0 0 0 1\n"
                               "m_calibrationColorExtrinsic = 1 0 0 0.1 0 1 0 0 0 0 1 0 0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.frames.size(), 1U);
  EXPECT_TRUE(any_has(played.warnings, "info.txt: its extrinsics are ignored"));
}

TEST(FolderRgbd, ErrorNamesMissingEntryOfSensorInfo) {
  const TempFolder folder;
  write_frame(folder, "frame-000000", 1000);
  folder.write("info.txt", kDepthInfo);
  expect_in("info.txt: m_colorWidth is missing or no positive number",
            message_of<DataError>([&] { open_dataset(folder.path()); }));
}

TEST(FolderRgbd, ReadsPairsInTheOrderOfNumbers) {
  const std::pair<const char*, const char*> names[] = {
      {"rgb_", "depth_"}, {"Color_", "Depth_"}, {"cam1.color.", "cam1.depth."}};
  for (const auto& [color, depth] : names) {
    const TempFolder folder;
    for (const int i : {2, 10, 1}) {
      write_color(folder.path() / (color + std::to_string(i) + ".png"));
      write_depth(folder.path() / (depth + std::to_string(i) + ".png"));
    }
    expect_in("has no camera calibration",
              message_of<DataError>([&] { open_dataset(folder.path()); }));
    folder.write("calibration.yaml", kCalibration);
    const Playback played(open_dataset(folder.path()));
    const std::string name = color;
    EXPECT_EQ(played.names(), name + "1 " + name + "2 " + name + "10");
    EXPECT_TRUE(any_has(played.source->describe(), "stamps: none, 15 Hz assumed (--rate)"));
  }
}

TEST(FolderRgbd, SkipsAndReportsMissingDepthAndPoses) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  write_frame(folder, "a", 1000);
  write_frame(folder, "b", 1000);
  std::filesystem::remove(folder.path() / "a.depth.png");
  folder.write("b.pose.txt", "-1.#IND 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const Playback played(open_dataset(folder.path()));
  EXPECT_EQ(played.names(), "b");
  EXPECT_EQ(played.source->ground_truth().size(), 1U);
  EXPECT_TRUE(any_has(played.warnings, "frame a skipped: "));
  EXPECT_TRUE(any_has(played.warnings, "pose skipped: "));
}

}  // namespace
}  // namespace mms
