#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

/// Commands and the words that their help must contain.
const std::map<Words, Words> kCommands = {
    {{},
     {"run", "eval", "reproduce", "simulate", "convert", "info", "config", "doctor", "cameras",
      "--version"}},
    {{"run"},
     {"DATA", "-c,--config", "-o,--output", "--segmenter", "network", "masks", "none", "--masks",
      "--fusion", "multimodal", "vision", "--frames", "--start", "--no-map-truth", "--realtime",
      "--threads", "--keep-journal", "--record"}},
    {{"eval"}, {"trajectory", "drift", "map", "ghost-points", "segmentation", "objects"}},
    {{"segment"},
     {"DATA", "-o,--output", "-c,--config", "--weights", "--annotations", "--split", "--limit",
      "--threads", "--json-only"}},
    {{"import"}, {"CHECKPOINT", "-o,--output", "--classes", "--half", "--overwrite"}},
    {{"eval", "trajectory"},
     {"REFERENCE", "ESTIMATE", "--json", "--max-difference", "--rpe-delta", "--rpe-unit"}},
    {{"reproduce"},
     {"DATA", "--trajectory", "-o,--output", "--trainings", "--segmenter", "--frames",
      "--threads"}},
    {{"eval", "drift"}, {"ESTIMATE", "--json"}},
    {{"eval", "map"}, {"TRUTH", "MAP", "--json"}},
    {{"eval", "ghost-points"}, {"DATA", "MAP", "--json"}},
    {{"eval", "objects"}, {"TRUTH", "RESULT", "--json"}},
    {{"simulate"},
     {"SCENE", "warehouse_loop", "-o,--output", "--seed", "--frames", "--sensor", "lidar16", "--hz",
      "--blur", "--set", "--threads", "--print", "training-set"}},
    {{"simulate", "training-set"}, {"-o,--output", "--images", "--seed", "--threads"}},
    {{"convert"},
     {"IN", "-o,--output", "--stamps", ".tum", "_kitti.txt", ".ply", ".pcd", "journal",
      "--overwrite", "--calibration"}},
    {{"info"}, {"DATA", "--masks", "--json"}},
    {{"cameras"}, {"--json"}},
    {{"config"}, {"dump", "check"}},
    {{"config", "dump"}, {"FILE"}},
    {{"config", "check"}, {"FILE"}},
    {{"doctor"}, {"--help", "--json"}},
};

/// Sets or unsets an environment variable and restores it at the end.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~ScopedVariable() { set(before_ ? before_->c_str() : nullptr); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  void set(const char* value) const {
    value == nullptr ? ::unsetenv(name_) : ::setenv(name_, value, 1);
  }

  const char* name_;
  std::optional<std::string> before_;
};

/// Wait policy that OpenMP reports last at the start of the program.
std::string last_wait_policy(const Outcome& outcome) {
  const std::size_t at = outcome.err.rfind("OMP_WAIT_POLICY = ");
  return at == std::string::npos ? "" : outcome.err.substr(at, outcome.err.find('\n', at) - at);
}

TEST(CommandLine, WaitingThreadsSleepByDefault) {
  const TempFolder folder;
  const ScopedVariable display("OMP_DISPLAY_ENV", "true");
  const ScopedVariable none("OMP_WAIT_POLICY", nullptr);
  EXPECT_EQ(last_wait_policy(run_mms(folder.path(), {"--version"})), "OMP_WAIT_POLICY = 'PASSIVE'");
  const ScopedVariable active("OMP_WAIT_POLICY", "active");
  EXPECT_EQ(last_wait_policy(run_mms(folder.path(), {"--version"})), "OMP_WAIT_POLICY = 'ACTIVE'");
}

TEST(CommandLine, HelpNamesEveryOption) {
  const TempFolder folder;
  for (const auto& [command, words] : kCommands) {
    Words arguments = command;
    arguments.emplace_back("--help");
    const Outcome outcome = run_mms(folder.path(), arguments);
    expect_success(outcome);
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    for (const std::string& word : words) expect_in(word, outcome.out);
  }
}

TEST(CommandLine, VersionIsOneLine) {
  const TempFolder folder;
  const Outcome outcome = run_mms(folder.path(), {"--version"});
  expect_success(outcome);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST(CommandLine, InvalidArgumentsAreUsageErrors) {
  const TempFolder folder;
  const auto run = [&](const Words& words) { return run_mms(folder.path(), words); };
  expect_usage_error(
      run({}),
      "no command given, expected run, ros2, cameras, batch, eval, reproduce, simulate, segment, "
      "quantize, import, ");
  expect_usage_error(run({"rum"}), "unknown command 'rum', did you mean 'run'?");
  expect_usage_error(run({"zzzzzz"}),
                     "unknown command 'zzzzzz', expected run, ros2, cameras, batch, eval");
  expect_usage_error(run({"help", "evl"}), "no command 'evl'; did you mean 'eval'?");
  expect_usage_error(
      run({"eval"}),
      "no command given, expected trajectory, drift, map, ghost-points, segmentation "
      "or objects");
  expect_usage_error(run({"eval", "trajektory", "a", "b"}), "'trajektory'");
  expect_usage_error(run({"run", "--frmes", "3"}),
                     "unknown option '--frmes', did you mean '--frames'? (mms run --help)");
  expect_usage_error(run({"run", "--frmes", "3", "data"}), "unknown option '--frmes'");
  expect_usage_error(run({"convert", "in", "--ouput=x"}), "did you mean '--output'?");
  expect_usage_error(run({"run", "one", "two"}), "unexpected argument 'two'");
  expect_usage_error(run({"run", "--fusion", "magic"}), "{multimodal,vision,none}");
  expect_usage_error(run({"run", "--frames", "0"}), "--frames: Value 0 not in range 1 to");
  expect_usage_error(run({"run", "--start", "-1"}), "--start: Value -1 not in range 0 to");
  expect_usage_error(run({"run", "--threads", "two"}), "--threads");
  expect_usage_error(run({"eval", "drift"}), "ESTIMATE is required");
  expect_usage_error(run({"info"}), "DATA is required");
}

TEST(CommandLine, UsageErrorsNameHelpCommand) {
  const TempFolder folder;
  expect_in("(mms eval drift --help)", run_mms(folder.path(), {"eval", "drift", "--x"}).err);
  expect_in("(mms --help)", run_mms(folder.path(), {"--x"}).err);
}

TEST(Info, DescribesRecording) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(5));
  const Outcome outcome = run_mms(folder.path(), {"info", "data"});
  expect_success(outcome);
  for (const char* fact :
       {"layout: TUM RGB-D", "5 color and 5 depth images, 5 matched", "masks: 5 of 5",
        "sensor: depth camera, 320x240 pixels\n", "depth scale: 1000 units per meter",
        "rate: 15.00 Hz", "ground truth: 5 poses", "frame 0: readable", "frame 2: readable",
        "frame 4: readable"}) {
    expect_in(fact, outcome.out);
  }
}

TEST(Info, ReportsDamagedFrame) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  folder.write("data/rgb/0000.png", "");
  const Outcome outcome = run_mms(folder.path(), {"info", "data"});
  expect_success(outcome);
  expect_in("frame 0: frame 0000 skipped: data/rgb/0000.png: is empty", outcome.out);
  expect_in("frame 1: readable", outcome.out);
}

TEST(Info, ReportsDamagedLastFrame) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  folder.write("data/rgb/0002.png", "");
  const Outcome outcome = run_mms(folder.path(), {"info", "data"});
  expect_in("frame 2: frame 0002 skipped", outcome.out);
}

TEST(Info, PrintsJson) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(3));
  folder.write("data/rgb/0000.png", "");
  const Outcome outcome = run_mms(folder.path(), {"info", "data", "--json"});
  expect_success(outcome);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["facts"]["layout"][0], "TUM RGB-D");
  EXPECT_EQ(json["checked_frames"][0]["index"], 0);
  EXPECT_EQ(json["checked_frames"][0]["readable"], false);
  EXPECT_EQ(json["checked_frames"][1]["readable"], true);
  EXPECT_TRUE(json["implausible"].is_array());
  const std::string weights = MMS_SOURCE_DIR "/weights/nano.safetensors";
  expect_error(run_mms(folder.path(), {"info", weights, "--json"}), "is a weights file");
}

TEST(CommandLine, DistributionOfRosMattersToItsNodeOnly) {
  const TempFolder folder;
  const ScopedVariable variable("ROS_DISTRO", "noetic");
  expect_success(run_mms(folder.path(), {"config", "dump"}));
  expect_success(run_mms(folder.path(), {"run", "--help"}));
}

TEST(Info, DescribesLidarFolder) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 2);
  const Outcome outcome = run_mms(folder.path(), {"info", "data"});
  expect_success(outcome);
  expect_in("layout: KITTI LiDAR scans", outcome.out);
  expect_in("frames: 2", outcome.out);
}

TEST(Doctor, PassesOnThisMachine) {
  const TempFolder folder;
  const Outcome outcome = run_mms(folder.path(), {"doctor"});
  expect_success(outcome);
  for (const char* line : {"cores", "memory", "tracking in a simulated warehouse", "ok"}) {
    expect_in(line, outcome.out);
  }
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(run_mms(folder.path(), {"doctor", "--json"}).out);
  EXPECT_EQ(json["ok"], true);
  EXPECT_EQ(json["checks"].size(), 3U);
  EXPECT_GT(json["network_time_per_image_ms"], 0.0);
}

}  // namespace
}  // namespace mms
