// Closed and full standard streams, and interrupted commands.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

/// Exit status of the program by a shell, with redirections.
int status_of(const TempFolder& folder, const std::string& line) {
  const std::string command = "cd '" + folder.path().string() + "' && '" MMS_PROGRAM "' " + line;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(Streams, LostOutputIsFault) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const TempFolder folder;
  EXPECT_EQ(status_of(folder, "config dump > /dev/full 2> err"), 1);
  EXPECT_EQ(status_of(folder, "--help > /dev/full 2> err"), 1);
  expect_in("mms: ", read_file(folder.path() / "err"));
  EXPECT_EQ(status_of(folder, "config dump >&- 2> err"), 1);
  EXPECT_EQ(status_of(folder, "config dump > out 2> err"), 0);
}

TEST(Streams, ClosedErrorStreamDoesNotSpoilFiles) {
  const TempFolder folder;
  const std::string run = "run 'sim:still_walker?frames=3' --segmenter none";
  EXPECT_EQ(status_of(folder, run + " -o a > out 2> err"), 0);
  EXPECT_EQ(status_of(folder, run + " -o b > out 2>&-"), 0);
  EXPECT_EQ(status_of(folder, run + " -o c > out 2>&- <&-"), 0);
  for (const char* file : {"trajectory.tum", "static_map.ply", "objects.json"}) {
    EXPECT_EQ(read_file(folder.path() / "b" / file), read_file(folder.path() / "a" / file)) << file;
    EXPECT_EQ(read_file(folder.path() / "c" / file), read_file(folder.path() / "a" / file)) << file;
  }
  EXPECT_EQ(status_of(folder, "run no_such_recording 2>&-"), 1);
}

/// Whether the folder of `file` has one whose name begins as it.
bool has_file(const fs::path& file) {
  if (!fs::exists(file.parent_path())) return false;
  const auto begins = [&](const fs::directory_entry& entry) {
    return entry.path().filename().string().starts_with(file.filename().string());
  };
  return std::any_of(fs::directory_iterator(file.parent_path()), {}, begins);
}

/// Waits for a file whose name begins so, at most a minute.
bool appears(const fs::path& file) {
  for (int i = 0; i < 6000 && !has_file(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return has_file(file);
}

/// Outcome of a command that gets a signal after a file appeared.
Outcome interrupted(const TempFolder& folder, const std::vector<std::string>& arguments,
                    const std::string& file) {
  RunningMms program(folder.path(), arguments);
  EXPECT_TRUE(appears(folder.path() / file));
  program.send(SIGINT);
  return program.wait();
}

TEST(Signals, InterruptedCommandsSaySo) {
  const TempFolder folder;
  const Outcome simulate =
      interrupted(folder, {"simulate", "still_walker", "-o", "data"}, "data/depth/0.200000000.png");
  EXPECT_EQ(simulate.exit_code, 130);
  expect_in("of 300 frames are written", simulate.err);
  const Outcome segment =
      interrupted(folder, {"segment", "sim:still_walker", "-o", "found"}, "found/overlays");
  EXPECT_EQ(segment.exit_code, 130) << segment.err;
  const Outcome convert =
      interrupted(folder, {"convert", "sim:still_walker", "-o", "x.bag"}, "x.partial.bag.tmp");
  EXPECT_EQ(convert.exit_code, 130) << convert.err;
  expect_in("of 300 frames are in x.partial.bag", convert.err);
  EXPECT_TRUE(fs::exists(folder.path() / "x.partial.bag"));
  EXPECT_FALSE(fs::exists(folder.path() / "x.bag"));
}

TEST(Signals, InterruptedConversionKeepsEarlierFiles) {
  const TempFolder folder;
  folder.write("x.bag", "earlier");
  folder.write("x.partial.bag", "mine");
  const Outcome convert = interrupted(
      folder, {"convert", "sim:still_walker", "-o", "x.bag", "--overwrite"}, "x.partial2.bag.tmp");
  EXPECT_EQ(convert.exit_code, 130) << convert.err;
  EXPECT_EQ(read_file(folder.path() / "x.bag"), "earlier");
  EXPECT_EQ(read_file(folder.path() / "x.partial.bag"), "mine");
  EXPECT_TRUE(fs::exists(folder.path() / "x.partial2.bag"));
}

TEST(Signals, SecondSignalRemovesTemporaryFiles) {
  const TempFolder folder;
  RunningMms convert(folder.path(), {"convert", "sim:still_walker", "-o", "x.bag"});
  ASSERT_TRUE(appears(folder.path() / "x.partial.bag.tmp"));
  convert.send(SIGINT);
  convert.send(SIGTERM);
  const int code = convert.wait().exit_code;
  EXPECT_TRUE(code == 128 + SIGTERM || code == 128 + SIGINT) << code;
  EXPECT_EQ(list_folder(folder.path()), (std::vector<std::string>{".stderr", ".stdout"}));
}

TEST(Signals, RunFinishesWritingItsResults) {
  const TempFolder folder;
  RunningMms run(folder.path(),
                 {"run", "sim:still_walker?frames=12", "--segmenter", "none", "-o", "out"});
  ASSERT_TRUE(appears(folder.path() / "out/trajectory.tum"));  // the first result
  run.send(SIGTERM);
  expect_success(run.wait());
  for (const char* file : {"metrics.json", "report.html", "run.json"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "out" / file)) << file;
  }
  EXPECT_FALSE(has_file(folder.path() / "out/journal.bin"));
}

TEST(Signals, IgnoredSignalStaysIgnored) {
  const TempFolder folder;
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  std::signal(SIGHUP, SIG_IGN);  // inherited by the program, as from nohup
  RunningMms run(folder.path(),
                 {"run", "sim:still_walker?frames=12", "--segmenter", "none", "-o", "out"});
  sigaction(SIGHUP, &before, nullptr);
  ASSERT_TRUE(appears(folder.path() / "out/journal.bin"));
  run.send(SIGHUP);
  expect_success(run.wait());
  EXPECT_EQ(json_file(folder.path() / "out/metrics.json")["frames"], 12);
}

}  // namespace
}  // namespace mms
