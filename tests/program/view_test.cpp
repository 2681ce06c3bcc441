#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "mms/io/text/files.hpp"
#include "mms/server/http/server.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"
#include "tests/server/client.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using namespace std::chrono_literals;

constexpr int kFrames = 12;

/// The port in the viewer's address line; 0 if none appears.
std::uint16_t port_of(const TempFolder& folder) {
  const std::string line = "viewer: http://localhost:";
  for (int i = 0; i < 6000; ++i) {
    const fs::path file = folder.path() / ".stderr";
    const std::string text = fs::exists(file) ? read_file(file) : "";
    const std::size_t at = text.find(line);
    if (at != std::string::npos && text.find('\n', at) != std::string::npos) {
      return static_cast<std::uint16_t>(std::stoi(text.substr(at + line.size())));
    }
    std::this_thread::sleep_for(10ms);
  }
  ADD_FAILURE() << "no line '" << line << "'";
  return 0;
}

void run_scene(const TempFolder& folder, const std::vector<std::string>& more = {}) {
  write_scene(folder.path() / "data", small_scene(kFrames));
  std::vector<std::string> words = {"run", "data", "--segmenter", "masks", "-o", "out"};
  words.insert(words.end(), more.begin(), more.end());
  expect_success(run_mms(folder.path(), words));
}

/// The first frame message with pictures.
DecodedMessage wait_for_pictures(ViewerClient& client) {
  while (true) {
    DecodedMessage message = client.wait_for("frame");
    if (message.json["pictures"] != "pending") return message;
  }
}

TEST(View, ShowsFinishedRunWithPictures) {
  const TempFolder folder;
  run_scene(folder);
  RunningMms program(folder.path(), {"view", "out", "--port", "0"});
  const std::uint16_t port = port_of(folder);
  ASSERT_NE(port, 0);
  expect_in("<html", http_get(port, "/").body);
  EXPECT_EQ(http_get(port, "/files/trajectory.tum").body,
            read_file(folder.path() / "out/trajectory.tum"));
  ViewerClient client(port);
  const nlohmann::json hello = client.wait_for("hello").json;
  EXPECT_EQ(hello["live"], false);
  EXPECT_EQ(hello["frames"], kFrames);
  EXPECT_EQ(hello["has_truth"], true);
  EXPECT_EQ(hello["has_pictures"], true);
  EXPECT_EQ(hello["image"]["width"], 320);
  const DecodedMessage trajectory = client.wait_for("trajectory");
  EXPECT_EQ(trajectory.values<float>("truth").size(), 3U * kFrames);
  const DecodedMessage frame = wait_for_pictures(client);
  EXPECT_EQ(frame.json["pictures"], "here");
  EXPECT_TRUE(frame.buffers.at("image").starts_with("\xff\xd8"));
  EXPECT_TRUE(frame.buffers.at("mask").starts_with("\x89PNG"));
  EXPECT_GT(frame.values<float>("points").size(), 1000U);
  const auto dynamic = frame.values<std::uint8_t>("dynamic");
  EXPECT_TRUE(std::count(dynamic.begin(), dynamic.end(), 1) > 0) << "a person walks ahead";
  program.send(SIGINT);
  EXPECT_EQ(program.wait().exit_code, 0);
}

TEST(View, ExplainsMissingPicturesWithoutRecording) {
  const TempFolder folder;
  run_scene(folder);
  fs::remove_all(folder.path() / "data");
  RunningMms program(folder.path(), {"view", "out", "--port", "0"});
  ViewerClient client(port_of(folder));
  const nlohmann::json hello = client.wait_for("hello").json;
  EXPECT_EQ(hello["has_pictures"], false);
  expect_in("data", hello["pictures_note"].get<std::string>());
  EXPECT_EQ(client.wait_for("frame").json["pictures"], "none");
  program.send(SIGTERM);
  const Outcome outcome = program.wait();
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "warning: no images and scans to show"), 1);
}

TEST(View, ExplainsMissingPicturesWithoutNetwork) {
  const TempFolder folder;
  const fs::path weights = folder.path() / "own.safetensors";
  fs::copy(MMS_SOURCE_DIR "/weights/nano.safetensors", weights);
  write_scene(folder.path() / "data", small_scene(3));
  folder.write("own.yaml", "segmentation: {weights: " + weights.string() + "}\n");
  expect_success(run_mms(folder.path(), {"run", "data", "-c", "own.yaml", "-o", "out"}));
  fs::remove(weights);
  RunningMms program(folder.path(), {"view", "out", "--port", "0"});
  ViewerClient client(port_of(folder));
  const nlohmann::json hello = client.wait_for("hello").json;
  EXPECT_EQ(hello["has_pictures"], false);
  expect_in("own.safetensors", hello["pictures_note"].get<std::string>());
}

TEST(View, ShowsRestOfDamagedFolder) {
  const TempFolder folder;
  run_scene(folder);
  const std::vector<std::string> damaged = {"static_map.ply", "objects.json", "truth.tum",
                                            "timing.csv",     "frames.csv",   "loops.csv",
                                            "run.json"};
  for (const std::string& name : damaged) folder.write("out/" + name, "1.0 no such row\n");
  RunningMms program(folder.path(), {"view", "out", "--port", "0"});
  ViewerClient client(port_of(folder));
  EXPECT_EQ(client.wait_for("hello").json["frames"], kFrames);
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  expect_success(outcome);
  for (const std::string& name : damaged) {
    EXPECT_EQ(lines_with(outcome, "warning: out/" + name), 1) << name;
  }
  folder.write("out/trajectory_map.tum", "1.0 no such row\n");
  expect_error(run_mms(folder.path(), {"view", "out", "--port", "0"}), "out/trajectory_map.tum:1");
}

TEST(View, ShowsKilledRun) {
  const TempFolder folder;
  run_scene(folder, {"--keep-journal"});
  fs::create_directories(folder.path() / "killed");
  fs::copy(folder.path() / "out/journal.bin", folder.path() / "killed/journal.bin");
  RunningMms program(folder.path(), {"view", "killed", "--port", "0"});
  ViewerClient client(port_of(folder));
  EXPECT_EQ(client.wait_for("hello").json["frames"], kFrames);
  EXPECT_GT(client.wait_for("map").values<float>("points").size(), 0U);
}

TEST(View, ShowsLiveRun) {
  const TempFolder folder;
  write_scene(folder.path() / "data", small_scene(30));
  RunningMms program(folder.path(), {"run", "data", "--segmenter", "masks", "-o", "out",
                                     "--realtime", "--view", "0"});
  ViewerClient client(port_of(folder));
  EXPECT_EQ(client.wait_for("hello").json["live"], true);
  const DecodedMessage frame = wait_for_pictures(client);
  EXPECT_EQ(frame.json["pictures"], "here");
  EXPECT_GT(frame.values<float>("points").size(), 1000U);
  const auto pose = frame.values<float>("pose");
  const auto truth = frame.values<float>("truth");
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(pose[axis], truth[axis], 0.05F);
  client.wait_for("map");
  const Outcome outcome = program.wait();
  expect_success(outcome);
  EXPECT_EQ(lines_with(outcome, "the viewer ends with the run"), 1);
  EXPECT_TRUE(fs::exists(folder.path() / "out/trajectory.tum"));
}

TEST(View, ViewersDoNotChangeResults) {
  const TempFolder folder;
  run_scene(folder);
  RunningMms program(folder.path(),
                     {"run", "data", "--segmenter", "masks", "-o", "seen", "--view", "0"});
  ViewerClient client(port_of(folder));
  while (client.read_bytes()) {
  }
  expect_success(program.wait());
  for (const char* file : {"trajectory.tum", "static_map.ply", "objects.json"}) {
    EXPECT_EQ(read_file(folder.path() / "out" / file), read_file(folder.path() / "seen" / file));
  }
}

TEST(View, WarnsWhenOpenToNetwork) {
  const TempFolder folder;
  run_scene(folder);
  RunningMms program(folder.path(), {"view", "out", "--port", "0", "--bind", "0.0.0.0"});
  EXPECT_NE(port_of(folder), 0);
  std::this_thread::sleep_for(100ms);
  program.send(SIGINT);
  EXPECT_EQ(lines_with(program.wait(), "the viewer is open to the network"), 1);
}

TEST(View, ErrorsExplainProblem) {
  const TempFolder folder;
  folder.write("empty/readme.txt", "x");
  folder.write("broken/trajectory.tum", "1 2 3\n");
  const auto view = [&](const std::string& where) {
    return run_mms(folder.path(), {"view", where, "--port", "0"});
  };
  expect_error(view("nowhere"), "nowhere: does not exist");
  expect_error(view("empty/readme.txt"), "is not a folder");
  expect_error(view("empty"), "is not a result folder");
  expect_error(view("broken"), "trajectory.tum:1");
  expect_usage_error(run_mms(folder.path(), {"view", "empty", "--port", "70000"}), "70000");
  expect_usage_error(run_mms(folder.path(), {"run", "data", "--view", "99999"}), "is not a port");
}

TEST(View, ErrorNamesUsedPort) {
  const TempFolder folder;
  run_scene(folder);
  ServerOptions options;
  options.port = 0;
  const ViewerServer other(options, std::make_shared<Scene>(SceneInfo{}));
  const std::string port = std::to_string(other.port());
  expect_error(run_mms(folder.path(), {"view", "out", "--port", port}),
               "port " + port + ": is in use");
  expect_error(run_mms(folder.path(), {"run", "data", "--segmenter", "masks", "--view", port}),
               "--view PORT");
  EXPECT_FALSE(fs::exists(folder.path() / "results")) << "no run began";
}

}  // namespace
}  // namespace mms
