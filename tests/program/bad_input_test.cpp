#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

Outcome run_data(const TempFolder& folder, const std::vector<std::string>& more = {}) {
  const std::string masks = segmenter_of(folder.path() / "data");
  std::vector<std::string> words = {"run", "data", "--segmenter", masks,
                                    "-o",  "out",  "--overwrite"};
  words.insert(words.end(), more.begin(), more.end());
  return run_mms(folder.path(), words);
}

/// Expects a run of data/ with skipped frames and one warning with the reason for each.
void expect_skipped(const TempFolder& folder, int frames, int skipped, const std::string& part) {
  const Outcome outcome = run_data(folder);
  expect_success(outcome);
  const auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(metrics["frames"], frames);
  EXPECT_EQ(metrics["frames_skipped"], skipped);
  EXPECT_EQ(lines_with(outcome, part), skipped) << outcome.err;
  EXPECT_EQ(lines_with(outcome, "warning: "), skipped) << outcome.err;
  EXPECT_EQ(read_trajectory_tum(folder.path() / "out/trajectory.tum").size(),
            static_cast<std::size_t>(frames));
}

TEST(BadInput, RejectsEmptyFolder) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "data");
  expect_error(run_data(folder),
               "data: is empty: no recording found (expected rgb.txt and depth.txt");
  expect_error(run_mms(folder.path(), {"info", "data"}), "data: is empty: no recording found");
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(BadInput, RejectsMissingFolder) {
  const TempFolder folder;
  expect_error(run_data(folder), "data: no such recording");
  folder.write("data", "a file");
  expect_error(run_data(folder), "data: is a file; a recording is a folder");
}

TEST(BadInput, RejectsMissingDepthList) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  fs::remove(folder.path() / "data/depth.txt");
  expect_error(run_data(folder), "data: is a TUM-layout sequence, but depth.txt is missing");
}

TEST(BadInput, SkipsTruncatedPng) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(4));
  for (const char* file : {"data/rgb/0001.png", "data/depth/0002.png"}) {
    const std::string bytes = read_file(folder.path() / file);
    folder.write(file, bytes.substr(0, bytes.size() / 2));
  }
  expect_skipped(folder, 2, 2, "truncated PNG");
}

TEST(BadInput, SkipsEightBitDepth) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  write_png(folder.path() / "data/depth/0001.png", Image<std::uint8_t>(320, 240, 9));
  expect_skipped(folder, 2, 1, "frame 0001 skipped: data/depth/0001.png: ");
}

TEST(BadInput, SkipsColorAndDepthOfDifferentSize) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  write_png(folder.path() / "data/depth/0000.png", Image<std::uint16_t>(80, 60, 1500));
  write_png(folder.path() / "data/rgb/0002.png", Image<Rgb>(80, 60));
  expect_skipped(folder, 1, 2, "is 80x60 pixels, the calibration has 320x240");
}

TEST(BadInput, SkipsMaskOfOtherSize) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  write_png(folder.path() / "data/masks/0001.png", Image<std::uint8_t>(80, 60));
  expect_skipped(folder, 2, 1, "data/masks/0001.png: is 80x60 pixels, the calibration has");
}

TEST(BadInput, RejectsRecordingWithoutValidFrames) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  fs::remove_all(folder.path() / "data/depth");
  expect_error(run_data(folder), "data: none of its 2 frames could be processed");
  EXPECT_FALSE(fs::exists(folder.path() / "out")) << "an empty folder of results is left over";
}

/// A recording with depth in its first and last frames only.
void write_scene_without_depth(const TempFolder& folder, int frames_without_depth) {
  write_scene(folder.path() / "data", small_scene(frames_without_depth + 8));
  for (int i = 4; i < frames_without_depth + 4; ++i) {
    write_png(folder.path() / "data/depth" / (frame_name(i) + ".png"),
              Image<std::uint16_t>(320, 240, 0));
  }
}

TEST(BadInput, SurvivesFiftyFramesWithoutDepth) {
  const TempFolder folder;
  write_scene_without_depth(folder, 50);
  expect_skipped(folder, 58, 0, "warning");
  expect_in("frames lost, poses predicted", run_data(folder).out);
  const auto status = json_file(folder.path() / "out/metrics.json")["status"];
  EXPECT_GT(status["lost"].get<int>() + status["degenerate"].get<int>(), 0);
  for (const StampedPose& pose : read_trajectory_tum(folder.path() / "out/trajectory.tum")) {
    EXPECT_LT(pose.T_world_sensor.translation().norm(), 5.0);
  }
}

TEST(BadInput, EndsRunWhoseFramesAreLost) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(1));
  write_png(folder.path() / "data/depth/empty.png", Image<std::uint16_t>(320, 240, 0));
  std::string color;
  std::string depth;
  for (int i = 0; i < 200; ++i) {
    const std::string stamp = std::to_string(100 + i / 10) + "." + std::to_string(i % 10) + " ";
    color += stamp + "rgb/" + frame_name(0) + ".png\n";
    depth += stamp + (i == 0 ? "depth/" + frame_name(0) : "depth/empty") + ".png\n";
  }
  folder.write("data/rgb.txt", color);
  folder.write("data/depth.txt", depth);
  const Outcome outcome = run_data(folder, {"--save-map", "a.mmsmap"});
  EXPECT_EQ(outcome.exit_code, 1);
  expect_in("frames were lost, so the run ended there", outcome.err);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.mmsmap"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.mmsmap.partial"));
  EXPECT_LT(json_file(folder.path() / "out/metrics.json")["frames"], 150);
}

TEST(BadInput, SurvivesRecordingWithoutDepth) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  for (int i = 0; i < 3; ++i) {
    write_png(folder.path() / "data/depth" / (frame_name(i) + ".png"),
              Image<std::uint16_t>(320, 240, 0));
  }
  const Outcome outcome = run_data(folder);
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "warning: implausible: only 0 % of the depth pixels"), 1);
  EXPECT_TRUE(read_ply(folder.path() / "out/static_map.ply").points.empty());
}

TEST(BadInput, SurvivesNonFiniteScanPoints) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 3);
  LidarScan scan = hall_scan(0.05);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(), 1e30F, 0.0F};
  for (std::size_t i = 0; i < scan.points.size(); i += 7) {
    scan.points[i][static_cast<int>(i % 3)] = bad[i % 5];
    scan.intensity[i] = bad[(i + 1) % 5];
  }
  write_scan(folder.path() / "data/000001.bin", scan);
  LidarScan invalid_scan = scan;
  for (auto& point : invalid_scan.points) point.setConstant(bad[0]);
  write_scan(folder.path() / "data/000002.bin", invalid_scan);
  expect_skipped(folder, 3, 0, "warning");
  const Trajectory poses = read_trajectory_tum(folder.path() / "out/trajectory.tum");
  EXPECT_NEAR(poses[1].T_world_sensor.translation().x(), 0.05, 0.02);
  const PointCloudFile map = read_ply(folder.path() / "out/static_map.ply");
  for (const auto& point : map.points) ASSERT_TRUE(point.allFinite());
  ASSERT_EQ(map.intensities.size(), map.points.size());
  for (const float intensity : map.intensities) {
    ASSERT_GE(intensity, 0.0F);
    ASSERT_LE(intensity, 1.0F);
  }
}

TEST(BadInput, SkipsEmptyScan) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 3);
  folder.write("data/000001.bin", "");
  expect_skipped(folder, 2, 1, "frame 000001 skipped: data/000001.bin: is empty");
}

TEST(BadInput, SkipsTruncatedScan) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 3);
  folder.write("data/000002.bin", std::string(1001, '\0'));
  expect_skipped(folder, 2, 1, "has 1001 bytes, not a multiple of 16");
}

TEST(BadInput, SkipsDecreasingTimes) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 3);
  folder.write("data/times.txt", "0.0\n0.2\n0.1\n");
  expect_skipped(folder, 2, 1, "frame 000002 skipped: its stamp 0.100000000 is not later than");
}

TEST(BadInput, RejectsUnwritableOutput) {
  const TempFolder folder;
  folder.write("occupied", "a file");
  const std::string small = "sim:corridor?width=320&frames=2";
  expect_error(run_mms(folder.path(), {"run", small, "--segmenter", "masks", "-o", "occupied"}),
               "occupied: cannot create the folder");
  expect_error(
      run_mms(folder.path(), {"run", small, "--segmenter", "masks", "-o", "occupied/below"}),
      "occupied/below: cannot create the folder");
}

TEST(BadInput, RejectsInvalidCalibration) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(2));
  folder.write("data/calibration.yaml", "fx: 100\nfy: wide\n");
  expect_error(run_data(folder), "calibration.yaml:2: ");
  fs::remove(folder.path() / "data/calibration.yaml");
  expect_error(run_data(folder), "data: has no camera calibration (add calibration.yaml with fx");
}

TEST(BadInput, RejectsInvalidSimulationAddress) {
  const TempFolder folder;
  expect_error(run_mms(folder.path(), {"run", "sim:crowd?sead=3"}),
               "unknown key 'sead' (did you mean 'seed'?");
  expect_error(run_mms(folder.path(), {"run", "sim:crowd?frames=many"}),
               "frames is 'many', allowed");
  expect_error(run_mms(folder.path(), {"run", "sim:hall"}), "sim:hall: ");
}

}  // namespace
}  // namespace mms
