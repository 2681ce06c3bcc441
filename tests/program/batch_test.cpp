// Many runs of one list, by the command of the program.
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kFirst = "sim_warehouse_loop_width=320_frames=3_seed=1_--segmenter_masks";
constexpr const char* kSecond = "sim_warehouse_loop_width=320_frames=3_seed=2_--segmenter_masks";

/// A list of runs of three frames, by seed.
void write_list(const TempFolder& folder, const std::vector<int>& seeds,
                const std::string& more = "") {
  std::string text = "# seeds\n\n";
  for (const int seed : seeds) {
    text += "'sim:warehouse_loop?width=320&frames=3&seed=" + std::to_string(seed) +
            "' --segmenter masks  # a seed\n";
  }
  write_file(folder.path() / "list.txt", text + more);
}

Outcome run_batch(const TempFolder& folder, const std::string& output,
                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"batch", "list.txt", "-o", output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_mms(folder.path(), arguments);
}

void expect_failed_runs(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(lines_with(outcome, "mms: list.txt: 1 of its runs failed"), 1) << outcome.err;
}

bool appears(const fs::path& path) {
  for (int i = 0; i < 3000 && !fs::exists(path); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return fs::exists(path);
}

TEST(Batch, WritesTablesAndGoesOnAfterFailures) {
  const TempFolder folder;
  write_list(folder, {1, 2}, "gone = missing_recording\n");
  const Outcome first = run_batch(folder, "out");
  expect_failed_runs(first);
  EXPECT_NE(first.out.find(kSecond), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("missing_recording: "), std::string::npos) << first.out;
  const fs::path out = folder.path() / "out";
  const std::string table = read_file(out / "batch.csv");
  EXPECT_NE(table.find(std::string(kFirst) + ",3,0,0.0"), std::string::npos) << table;
  EXPECT_NE(table.find("\nmedian,3,0,"), std::string::npos) << table;
  EXPECT_TRUE(fs::exists(out / "runs" / kFirst / "trajectory.tum"));
  EXPECT_NE(read_file(out / "report.html").find(kFirst), std::string::npos);

  const auto written = fs::last_write_time(out / "runs" / kFirst / "trajectory.tum");
  fs::create_directory(folder.path() / "missing_recording");
  const Outcome second = run_batch(folder, "out");
  expect_failed_runs(second);  // tried again: the folder is empty
  EXPECT_EQ(lines_with(second, "[3/3] gone"), 1);
  EXPECT_EQ(lines_with(second, kFirst), 0);
  EXPECT_EQ(fs::last_write_time(out / "runs" / kFirst / "trajectory.tum"), written);
  EXPECT_EQ(read_file(out / "batch.csv"), table);
}

/// Counts how often a file is put into a folder.
class Arrivals {
 public:
  explicit Arrivals(const fs::path& folder) : descriptor_(inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(inotify_add_watch(descriptor_, folder.c_str(), IN_MOVED_TO), 0);
  }
  ~Arrivals() { ::close(descriptor_); }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  int number_of(const std::string& name) const {
    int count = 0;
    std::array<char, 65536> bytes{};
    ssize_t size = 0;
    while ((size = ::read(descriptor_, bytes.data(), bytes.size())) > 0) {
      for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
        std::uint32_t length = 0;  // of the name behind the event
        std::memcpy(&length, bytes.data() + at + offsetof(inotify_event, len), sizeof length);
        at += sizeof(inotify_event);
        count += name == bytes.data() + at ? 1 : 0;
        at += length;
      }
    }
    return count;
  }

 private:
  int descriptor_;
};

/// A batch of a thousand runs must not read all results a thousand times.
TEST(Batch, WritesTablesOnceWhereAllRunsAreThere) {
  const TempFolder folder;
  write_list(folder, {1, 2});
  expect_success(run_batch(folder, "out"));
  const Arrivals arrivals(folder.path() / "out");
  expect_success(run_batch(folder, "out"));
  EXPECT_EQ(arrivals.number_of("batch.csv"), 1);
}

TEST(Batch, DamagedResultsOfOneRunDoNotHideTheOthers) {
  const TempFolder folder;
  write_list(folder, {1, 2});
  expect_success(run_batch(folder, "out"));
  write_file(folder.path() / "out/runs" / kFirst / "metrics.json", "{");
  const Outcome outcome = run_batch(folder, "out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(lines_with(outcome, "1 of its runs have results that cannot be read"), 1)
      << outcome.err;
  EXPECT_NE(outcome.out.find("metrics.json: is not JSON"), std::string::npos) << outcome.out;
  const std::string table = read_file(folder.path() / "out/batch.csv");
  EXPECT_NE(table.find(std::string(kSecond) + ",3,0,"), std::string::npos) << table;
  EXPECT_EQ(table.find(kFirst), std::string::npos) << table;
}

TEST(Batch, SharesFolderAndGoesOnAfterKill) {
  const TempFolder folder;
  write_list(folder, {1, 2, 3, 4});
  expect_success(run_batch(folder, "alone"));
  {
    RunningMms killed(folder.path(), {"batch", "list.txt", "-o", "shared"});
    ASSERT_TRUE(appears(folder.path() / "shared/claims" / kFirst));
    killed.send(SIGKILL);
    EXPECT_EQ(killed.wait().exit_code, 128 + SIGKILL);
  }
  RunningMms one(folder.path(), {"batch", "list.txt", "-o", "shared"});
  RunningMms other(folder.path(), {"batch", "list.txt", "-o", "shared"});
  const Outcome ones = one.wait();
  const Outcome others = other.wait();
  expect_success(ones);
  expect_success(others);
  EXPECT_EQ(lines_with(ones, "/4] ") + lines_with(others, "/4] "), 4);
  EXPECT_EQ(read_file(folder.path() / "shared/batch.csv"),
            read_file(folder.path() / "alone/batch.csv"));
  for (const std::string& name : list_folder(folder.path() / "alone/runs")) {
    EXPECT_EQ(read_file(folder.path() / "shared/runs" / name / "trajectory.tum"),
              read_file(folder.path() / "alone/runs" / name / "trajectory.tum"));
  }
}

TEST(Batch, InterruptedRunIsNotFinished) {
  const TempFolder folder;
  write_file(folder.path() / "list.txt",
             std::string_view("sim:warehouse_loop?frames=300 --segmenter masks\n"));
  RunningMms run(folder.path(), {"batch", "list.txt", "-o", "out"});
  const std::string name = "sim_warehouse_loop_frames=300_--segmenter_masks";
  ASSERT_TRUE(appears(folder.path() / "out/unfinished" / name / "journal.bin"));
  run.send(SIGTERM);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out/runs" / name));
  EXPECT_FALSE(fs::exists(folder.path() / "out/failed" / name));
}

TEST(Batch, ShardsDivideTheList) {
  const TempFolder folder;
  write_list(folder, {1, 2});
  expect_success(run_batch(folder, "out", {"--shard", "2/2"}));
  EXPECT_FALSE(fs::exists(folder.path() / "out/runs" / kFirst));
  EXPECT_TRUE(fs::exists(folder.path() / "out/runs" / kSecond));
  for (const char* wrong : {"0/2", "3/2", "1", "a/b", "1/0"}) {
    expect_error(run_batch(folder, "out", {"--shard", wrong}), "expected i/n");
  }
}

TEST(Batch, RefusesBadLists) {
  const TempFolder folder;
  const auto refused = [&](const std::string& text, const std::string& part) {
    write_file(folder.path() / "list.txt", text);
    expect_error(run_batch(folder, "out"), part);
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
  };
  refused("# none\n", "has no runs");
  refused("a\n'b\n", "list.txt:2: has a quote without end");
  refused("a\n\na # again\n", "list.txt:3: has the same name as line 1: a");
  refused("x = a\nx = b\n", "list.txt:2: has the same name as line 1: x");
  refused("a/b = c\n", "list.txt:1: has the name 'a/b'");
  refused("a =\n", "list.txt:1: has a name without a recording");
  refused("a --output=b\n", "list.txt:1: has the option --output");
  refused("a -ob\n", "list.txt:1: has the option -o");
  expect_error(run_mms(folder.path(), {"batch", "no_list", "-o", "out"}), "no_list");
  fs::create_directory(folder.path() / "mine");
  write_file(folder.path() / "mine/thesis.txt", std::string_view("text"));
  write_file(folder.path() / "list.txt", std::string_view("a\n"));
  expect_error(run_batch(folder, "mine"), "is not empty and has no batch");
  EXPECT_EQ(list_folder(folder.path() / "mine").size(), 1U);
}

}  // namespace
}  // namespace mms
