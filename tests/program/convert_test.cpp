#include <gtest/gtest.h>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

Trajectory sample_poses() {
  Trajectory poses;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(0.1 * i, 1.0, 2.0) *
        Eigen::Isometry3d(Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitY()));
    poses.push_back({Timestamp(1'500'000'000LL + i), Transform<World, Sensor>(pose)});
  }
  return poses;
}

void expect_same(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].stamp, b[i].stamp);
    EXPECT_TRUE(a[i].T_world_sensor.isometry().isApprox(b[i].T_world_sensor.isometry()));
  }
}

TEST(Convert, LeavesOutPointsThatAreNotFinite) {
  const TempFolder folder;
  folder.write("a.pcd",
               "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
               "POINTS 3\nDATA ascii\n1 2 3\nnan 0 0\n1e99 2 3\n");
  const Outcome outcome = run_mms(folder.path(), {"convert", "a.pcd"});
  expect_success(outcome);
  expect_in("a.ply: 1 points, without 2 that are not finite", outcome.out);
  const auto points = read_ply(folder.path() / "a.ply").points;
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0], Eigen::Vector3f(1, 2, 3));
}

TEST(Convert, ConvertsTrajectoriesBothDirections) {
  const TempFolder folder;
  write_trajectory_tum(folder.path() / "a.tum", sample_poses());
  const Outcome forward = run_mms(folder.path(), {"convert", "a.tum"});
  expect_success(forward);
  expect_in("a_kitti.txt: 3 poses, without stamps", forward.out);
  fs::rename(folder.path() / "a.tum", folder.path() / "stamps.tum");
  expect_success(run_mms(folder.path(), {"convert", "a_kitti.txt", "--stamps", "stamps.tum"}));
  expect_same(read_trajectory_tum(folder.path() / "a.tum"), sample_poses());
}

TEST(Convert, AcceptsTumTrajectoryNamedTxt) {
  const TempFolder folder;
  write_trajectory_tum(folder.path() / "groundtruth.txt", sample_poses());
  expect_success(run_mms(folder.path(), {"convert", "groundtruth.txt", "-o", "a.tum"}));
  expect_same(read_trajectory_tum(folder.path() / "a.tum"), sample_poses());
}

TEST(Convert, ConvertsCloudsBothDirections) {
  const TempFolder folder;
  const PointCloudFile cloud{
      {{1, 2, 3}, {-4, 5, 0.5F}}, {{0, 0, 1}, {0, 1, 0}}, {{1, 2, 3}, {255, 0, 9}}, {}, {7, 2}};
  write_ply(folder.path() / "a.ply", cloud);
  expect_in("a.pcd: 2 points", run_mms(folder.path(), {"convert", "a.ply"}).out);
  expect_success(run_mms(folder.path(), {"convert", "a.pcd", "-o", "b.PLY"}));
  EXPECT_EQ(read_file(folder.path() / "a.ply"), read_file(folder.path() / "b.PLY"));
}

TEST(Convert, ReplacesFilesOnlyIfAsked) {
  const TempFolder folder;
  write_trajectory_tum(folder.path() / "a.tum", sample_poses());
  folder.write("a_kitti.txt", "mine");
  expect_error(run_mms(folder.path(), {"convert", "a.tum"}),
               "a_kitti.txt: exists already (replace it with --overwrite)");
  EXPECT_EQ(read_file(folder.path() / "a_kitti.txt"), "mine");
  expect_success(run_mms(folder.path(), {"convert", "a.tum", "--overwrite"}));
  expect_error(run_mms(folder.path(), {"convert", "a.tum", "-o", "a.tum"}), "exists already");
}

TEST(Convert, TurnsMapsAndTrajectoriesLevel) {
  const TempFolder folder;
  const auto convert = [&](const std::string& from, const std::string& to) {
    return run_mms(folder.path(), {"convert", from, "-o", to, "--frame", "level"});
  };
  write_ply(folder.path() / "a.ply", {{{1, 2, 3}}, {{0, -1, 0}}, {}, {}, {}});
  write_trajectory_tum(folder.path() / "a.tum", sample_poses());
  expect_error(convert("a.ply", "b.ply"), "map.yaml: no such file");
  folder.write("map.yaml", "mode: trinary\n");
  expect_error(convert("a.ply", "b.ply"), "map.yaml: has no T_world_map.translation of 3 numbers");
  // The camera is 1.5 m above the floor: z of the map is -y of the camera.
  folder.write("map.yaml",
               "mode: trinary\nT_world_map:\n  translation: [0, 1.5, 0]\n"
               "  quaternion: [0.5, -0.5, 0.5, 0.5]\n");
  expect_success(convert("a.ply", "b.ply"));
  const PointCloudFile level = read_ply(folder.path() / "b.ply");
  EXPECT_TRUE(level.points.at(0).isApprox(Eigen::Vector3f(3.0F, -1.0F, -0.5F), 1e-5F));
  EXPECT_TRUE(level.normals.at(0).isApprox(Eigen::Vector3f::UnitZ(), 1e-5F));
  expect_in("comment frame: map, level", read_file(folder.path() / "b.ply"));
  expect_success(convert("a.tum", "b.tum"));
  const Trajectory poses = read_trajectory_tum(folder.path() / "b.tum");
  const Eigen::Vector3d t = sample_poses()[1].T_world_sensor.translation();
  EXPECT_TRUE(poses[1].T_world_sensor.translation().isApprox(
      Eigen::Vector3d(t.z(), -t.x(), 1.5 - t.y()), 1e-9));
}

TEST(Convert, ErrorsExplainImpossibleConversions) {
  const TempFolder folder;
  const auto run = [&](const Words& words) {
    Words all = {"convert"};
    all.insert(all.end(), words.begin(), words.end());
    return run_mms(folder.path(), all);
  };
  write_trajectory_tum(folder.path() / "a.tum", sample_poses());
  write_trajectory_kitti(folder.path() / "k.txt", sample_poses());
  folder.write("empty.ply", "");
  folder.write("empty.txt", "");
  folder.write("two.txt", "1\n2\n");
  folder.write("words.txt", "one\n");
  fs::create_directory(folder.path() / "results");
  expect_usage_error(run({}), "IN is required");
  expect_error(run({"none.tum"}), "none.tum: no such file");
  expect_error(run({"a.obj"}),
               "a.obj: has the unknown extension '.obj' (supported: trajectories .tum");
  expect_error(run({"a"}), "a: has no extension");
  expect_error(run({"empty.ply"}), "empty.ply");
  expect_error(run({"empty.txt"}), "empty.txt: has no poses");
  expect_error(run({"a.tum", "-o", "a.ply"}), "a.ply: is a cloud, but a.tum is a trajectory");
  expect_error(run({"k.txt"}),
               "k.txt: has no stamps, which TUM trajectories require (use --stamps");
  expect_error(run({"k.txt", "--stamps", "two.txt"}), "k.txt: 3 poses and 2 stamps");
  expect_error(run({"k.txt", "--stamps", "words.txt"}), "words.txt:1: 'one' is not a stamp");
  expect_error(run({"a.tum", "--stamps", "two.txt"}), "a.tum has stamps");
  expect_error(run({"results"}), "results: has no journal.bin");
}

TEST(Convert, ErrorsExplainDamagedJournal) {
  const TempFolder folder;
  const std::string header = encode_header({"data", 0.02, 2});
  const auto convert = [&](const std::string& bytes) {
    folder.write("results/journal.bin", bytes);
    return run_mms(folder.path(), {"convert", "results"});
  };
  expect_error(convert(""), "results/journal.bin: is empty");
  expect_error(convert("not one"), "results/journal.bin: is not a journal");
  expect_error(convert(header.substr(0, 20)), "results/journal.bin: the record at byte 8");
  expect_error(convert(header), "results/journal.bin: has no complete frame");
  expect_error(convert(header + "\xFF\xFF\xFF\x7F torn"), "has no complete frame");
  EXPECT_FALSE(fs::exists(folder.path() / "results/trajectory.tum"));
  const Outcome outcome = convert(header + encode_frame({}) + "torn");
  expect_success(outcome);
  expect_error(convert(header + encode_frame({})), "results/trajectory.tum: exists already");
  expect_in("data: 1 frames up to stamp 0.000000000", outcome.out);
  expect_in("the record at byte", outcome.out);
}

}  // namespace
}  // namespace mms
