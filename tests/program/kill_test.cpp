#include <gtest/gtest.h>
#include <signal.h>

#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

constexpr int kFrames = 30;
constexpr std::uintmax_t kFirstFrames = 20000;  // bytes of a journal with a few frames

Words run_words(const std::string& out, const Words& more = {}) {
  Words words = {"run", "data", "--segmenter", "masks", "-o", out};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

bool wait_for_size(const fs::path& file, std::uintmax_t size) {
  return wait_until([&] { return size_of(file) >= size; });
}

TEST(Kill, KeptJournalHoldsWholeRun) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_mms(folder.path(), run_words("out", {"--keep-journal"})));
  const Outcome outcome = run_mms(folder.path(), {"convert", "out", "-o", "copy/of/it"});
  expect_success(outcome);
  expect_in("data: 30 frames up to stamp 101.93", outcome.out);
  EXPECT_EQ(outcome.out.find("nothing is known"), std::string::npos) << outcome.out;
  const fs::path out = folder.path() / "out";
  const fs::path copy = folder.path() / "copy/of/it";
  for (const char* file : {"trajectory.tum", "trajectory_kitti.txt", "keyframes.tum"}) {
    EXPECT_EQ(read_file(out / file), read_file(copy / file)) << file;
  }
  EXPECT_EQ(read_ply(out / "static_map.ply").points.size(),
            read_ply(copy / "static_map.ply").points.size());
  EXPECT_TRUE(fs::exists(copy / "static_map.pcd"));
}

TEST(Kill, KilledRunLeavesResultsSoFar) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  expect_success(run_mms(folder.path(), run_words("whole", {"--keep-journal"})));
  const std::uintmax_t size = size_of(folder.path() / "whole/journal.bin");
  const std::string trajectory = read_file(folder.path() / "whole/trajectory.tum");
  const std::size_t points = read_ply(folder.path() / "whole/static_map.ply").points.size();
  for (const double share : {0.1, 0.4, 0.7, 0.9}) {
    SCOPED_TRACE(share);
    const fs::path out = folder.path() / "killed";
    fs::remove_all(out);
    RunningMms run(folder.path(), run_words("killed", {"--keep-journal"}));
    ASSERT_TRUE(wait_for_size(out / "journal.bin",
                              static_cast<std::uintmax_t>(share * static_cast<double>(size))));
    run.send(SIGKILL);
    EXPECT_EQ(run.wait().exit_code, 128 + SIGKILL);
    expect_success(run_mms(folder.path(), {"convert", "killed"}));
    EXPECT_TRUE(trajectory.starts_with(read_file(out / "trajectory.tum")));
    const std::size_t recovered = read_ply(out / "static_map.ply").points.size();
    EXPECT_GT(recovered, 1000U);
    EXPECT_LT(recovered, points + points / 2);
  }
}

TEST(Kill, FailedRunSaysHowToGetItsFrames) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  RunningMms run(folder.path(), run_words("out"));
  ASSERT_TRUE(wait_for_size(folder.path() / "out/journal.bin", 1));
  fs::create_directory(folder.path() / "out/trajectory.tum");  // where a file is to be written
  const Outcome outcome = run.wait();
  expect_error(outcome, "trajectory.tum: cannot be written");
  EXPECT_EQ(lines_with(outcome, "mms convert out -o NEW"), 1) << outcome.err;
  const Outcome convert = run_mms(folder.path(), {"convert", "out", "-o", "new"});
  expect_success(convert);
  expect_in("data: 30 frames", convert.out);
}

TEST(Kill, TerminationSignalsLetRunWriteResults) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  for (const int signal : {SIGTERM, SIGINT}) {
    SCOPED_TRACE(signal);
    const fs::path out = folder.path() / "out";
    fs::remove_all(out);
    RunningMms run(folder.path(), run_words("out", {"--realtime"}));
    ASSERT_TRUE(wait_for_size(out / "journal.bin", kFirstFrames));
    run.send(signal);
    const Outcome outcome = run.wait();
    expect_success(outcome);
    EXPECT_EQ(lines_with(outcome, "interrupted, writing the results so far"), 1);
    const std::size_t poses = read_trajectory_tum(out / "trajectory.tum").size();
    EXPECT_GE(poses, 1U);
    EXPECT_LT(poses, std::size_t{kFrames});
    for (const char* file :
         {"trajectory_kitti.txt", "keyframes.tum", "static_map.ply", "static_map.pcd",
          "objects.json", "metrics.json", "timing.csv", "config.yaml", "report.html"}) {
      EXPECT_TRUE(fs::exists(out / file)) << file;
    }
    EXPECT_FALSE(fs::exists(out / "journal.bin"));
  }
}

TEST(Kill, SecondSignalEndsRunImmediately) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(kFrames));
  RunningMms run(folder.path(), run_words("out", {"--realtime", "--save-map", "a.mmsmap"}));
  ASSERT_TRUE(wait_for_size(folder.path() / "out/journal.bin", kFirstFrames));
  ASSERT_TRUE(fs::exists(folder.path() / "a.mmsmap.partial"));
  run.send(SIGINT);
  run.send(SIGTERM);
  const int code = run.wait().exit_code;  // either may be the second one
  EXPECT_TRUE(code == 128 + SIGTERM || code == 128 + SIGINT) << code;
  EXPECT_TRUE(fs::exists(folder.path() / "out/journal.bin"));
  EXPECT_FALSE(fs::exists(folder.path() / "a.mmsmap.partial"));
}

TEST(Kill, UnwritableJournalGivesWarning) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  fs::create_directory(folder.path() / "out");
  fs::create_symlink("/dev/full", folder.path() / "out/journal.bin");
  const Outcome outcome = run_mms(folder.path(), run_words("out"));
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "warning: out/journal.bin: cannot be written: No space left"), 1);
  EXPECT_EQ(read_trajectory_tum(folder.path() / "out/trajectory.tum").size(), 3U);
}

}  // namespace
}  // namespace mms
