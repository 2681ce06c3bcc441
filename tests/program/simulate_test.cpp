#include <gtest/gtest.h>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

/// `mms simulate` of a small scene with more arguments.
Outcome simulate(const TempFolder& folder, const Words& more) {
  Words words = {"simulate", "still_walker", "--frames", "2", "--set", "width=96"};
  words.insert(words.end(), more.begin(), more.end());
  return run_mms(folder.path(), words);
}

TEST(Simulate, WritesUsableRecording) {
  const TempFolder folder;
  const Outcome outcome =
      simulate(folder, {"-o", "data", "--sensor", "d435", "--seed", "3", "--set", "width=320"});
  expect_success(outcome);
  expect_in("data: 2 frames of d435", outcome.out);
  expect_in("play it: mms run data", outcome.out);
  EXPECT_EQ(lines_with(outcome, "frame 2/2  "), 1);
  for (const char* file : {"rgb.txt", "depth.txt", "groundtruth.txt", "groundtruth_dense.txt",
                           "calibration.yaml", "objects_truth.json", "instances.json",
                           "static_truth.ply", "map_truth.ply", "scene.yaml"}) {
    EXPECT_TRUE(fs::is_regular_file(folder.path() / "data" / file)) << file;
  }
  expect_success(run_mms(folder.path(), {"run", "data", "--segmenter", "masks", "-o", "out"}));
  const auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(keys_of(metrics["map"]),
            (std::set<std::string>{"sa_pct", "da_pct", "aa_pct", "ha_pct"}));
  expect_in("SA (static points kept)", read_file(folder.path() / "out/report.html"));
}

TEST(Simulate, SameBytesForAnyThreadCount) {
  const TempFolder folder;
  expect_success(simulate(folder, {"-o", "a", "--blur", "2", "--threads", "1"}));
  expect_success(run_mms(folder.path(), {"simulate", "a/scene.yaml", "-o", "b"}));
  for (const char* file : {"objects_truth.json", "instances.json", "map_truth.ply",
                           "groundtruth.txt", "rgb/0.066666667.jpg", "depth/0.066666667.png"}) {
    EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file)) << file;
  }
}

TEST(Simulate, KeepsEarlierSimulationUnlessTold) {
  const TempFolder folder;
  expect_success(simulate(folder, {"-o", "data"}));
  const std::string scene = read_file(folder.path() / "data/scene.yaml");
  expect_error(simulate(folder, {"-o", "data", "--seed", "3"}),
               "data: has an earlier simulation (replace it with --overwrite");
  EXPECT_EQ(read_file(folder.path() / "data/scene.yaml"), scene);
  EXPECT_TRUE(fs::exists(folder.path() / "data/rgb.txt"));
  expect_success(simulate(folder, {"-o", "data", "--seed", "3", "--overwrite"}));
  EXPECT_NE(read_file(folder.path() / "data/scene.yaml"), scene);
}

TEST(Simulate, PrintsSceneAsYaml) {
  const TempFolder folder;
  const Outcome outcome = simulate(folder, {"--print", "--set", "mask_errors.enabled=true"});
  expect_success(outcome);
  expect_in("frames: 2", outcome.out);
  expect_in("  enabled: true", outcome.out);
  EXPECT_FALSE(fs::exists(folder.path() / "scene.yaml"));
  folder.write("my.yaml", outcome.out);
  expect_success(run_mms(folder.path(), {"simulate", "my.yaml", "-o", "data"}));
}

TEST(Simulate, AcceptsValuesBeforeScene) {
  const TempFolder folder;
  const Outcome outcome = run_mms(
      folder.path(), {"simulate", "--set", "seed=8", "--set", "agvs=1", "crowd", "--print"});
  expect_success(outcome);
  expect_in("of 'crowd'", outcome.out);
  expect_in("seed: 8", outcome.out);
  expect_in("agvs: 1", outcome.out);
}

TEST(Simulate, AcceptsSimAddresses) {
  const Outcome outcome =
      run_mms(TempFolder().path(), {"simulate", "sim:crowd?seed=8&agvs=1", "--print"});
  expect_success(outcome);
  expect_in("of 'crowd'", outcome.out);
  expect_in("seed: 8", outcome.out);
  expect_in("agvs: 1", outcome.out);
}

TEST(Simulate, ErrorsExplainProblem) {
  const TempFolder folder;
  expect_usage_error(simulate(folder, {}), "--output is required");
  expect_error(run_mms(folder.path(), {"simulate", "crwd", "-o", "x"}), "did you mean 'crowd'?");
  expect_error(run_mms(folder.path(), {"simulate", "crowd?seed=3", "-o", "x"}),
               "with values it is sim:crowd?seed=3");
  expect_error(simulate(folder, {"-o", "x", "--sensor", "d453"}), "--sensor: sensor cannot be");
  expect_error(simulate(folder, {"-o", "x", "--seed", "-1"}), "--seed: seed is '-1', allowed:");
  expect_error(simulate(folder, {"-o", "x", "--set", "spead=1"}), "did you mean 'speed'?");
  folder.write("bad.yaml", "sped: 1\n");
  expect_error(run_mms(folder.path(), {"simulate", "bad.yaml", "-o", "x"}), "bad.yaml:1");
  folder.write("full/mine.txt", "x");
  expect_error(simulate(folder, {"-o", "full"}), "full: is not empty (it has mine.txt)");
  EXPECT_FALSE(fs::exists(folder.path() / "x"));
}

TEST(Simulate, RunsWithoutFiles) {
  const TempFolder folder;
  expect_success(run_mms(folder.path(), {"run", "sim:still_walker?frames=3&width=320",
                                         "--segmenter", "masks", "-o", "out"}));
  const auto metrics = json_file(folder.path() / "out/metrics.json");
  EXPECT_EQ(metrics["frames"], 3);
  EXPECT_TRUE(metrics.contains("map"));
}

TEST(Simulate, DamagedGroundTruthMapGivesWarning) {
  const TempFolder folder;
  expect_success(simulate(folder, {"-o", "data"}));
  folder.write("data/map_truth.ply", "ply\n");
  const Outcome outcome =
      run_mms(folder.path(), {"run", "data", "--segmenter", "masks", "-o", "out"});
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "warning: the map is not evaluated: data/map_truth.ply"), 1);
  EXPECT_FALSE(json_file(folder.path() / "out/metrics.json").contains("map"));
}

TEST(Simulate, WritesTrainingSet) {
  const TempFolder folder;
  const Words words = {"simulate", "training-set", "-o", "set", "--images", "2", "--seed", "4"};
  const Outcome outcome = run_mms(folder.path(), words);
  expect_success(outcome);
  expect_in("set: 2 images, 2 of them rendered by this call", outcome.out);
  expect_in("2 images, 0 of them rendered by this call", run_mms(folder.path(), words).out);
  const auto dataset = json_file(folder.path() / "set/annotations.json");
  EXPECT_EQ(dataset["images"].size(), 2U);
  EXPECT_TRUE(fs::exists(folder.path() / "set/images/000001.jpg"));
  expect_usage_error(run_mms(folder.path(), {"simulate", "training-set", "-o", "set"}),
                     "--images is required");
}

}  // namespace
}  // namespace mms
