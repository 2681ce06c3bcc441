#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <map>
#include <memory>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kConfig = R"(
network: {long_side: 128, short_side: 96, head: {grid_density: 0.4, object_scale: 20}}
data:
  - {annotations: data/annotations.json}
  - {annotations: data/annotations.json, repeat: 0.5}
validation:
  - {annotations: data/annotations.json}
half_precision: false
schedule: {images: 8, batch: 2, warm_up: 2}
)";

/// Complete workflow: simulated images, a short training, segmentation with its weights.
TEST(Train, TrainsUsableWeights) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "4"}));
  folder.write("train.yaml", kConfig);
  const Outcome outcome = run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"});
  expect_success(outcome);
  expect_in("weights: out/weights.safetensors", outcome.out);
  for (const char* file : {"checkpoint.pt", "log.json", "report.html", "config.yaml"}) {
    EXPECT_TRUE(fs::is_regular_file(folder.path() / "out" / file)) << file;
  }
  expect_success(run_mms(folder.path(), {"segment", "data/images", "--weights",
                                         "out/weights.safetensors", "-o", "found"}));
  expect_success(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}));  // has ended
}

TEST(Train, GoesOnWithoutBadAnnotations) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "4"}));
  std::string text = read_file(folder.path() / "data/annotations.json");
  const std::size_t box = text.find("\"bbox\":[");
  ASSERT_NE(box, std::string::npos);
  text.insert(box + 8, "9");
  folder.write("data/annotations.json", text);
  folder.write("train.yaml", R"(
network: {long_side: 128, short_side: 96}
data: [{annotations: data/annotations.json}]
half_precision: false
schedule: {images: 2, batch: 2}
)");
  const Outcome outcome = run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"});
  expect_success(outcome);
  expect_in("warning: data/annotations.json: annotations[", outcome.err);
  expect_in("outside of its image", outcome.err);
  expect_in("left out: 1 image or annotation, see left_out.txt", outcome.err);
  expect_in("outside of its image", read_file(folder.path() / "out/left_out.txt"));
}

/// A network with more parts starts from the shipped weights of a simpler one.
TEST(Train, StartsFromSimplerNetwork) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "2"}));
  folder.write("train.yaml", R"(
network: {variant: solov2+detectors, long_side: 128, short_side: 96}
initial_weights: )" MMS_SOURCE_DIR R"(/weights/nano.safetensors
data:
  - {annotations: data/annotations.json}
half_precision: false
schedule: {images: 2, batch: 2}
)");
  expect_success(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}));
  const Outcome outcome = run_mms(folder.path(), {"info", "out/weights.safetensors"});
  expect_in("variant: solov2+detectors", outcome.out);
}

/// Sets environment variables for programs that are started during its lifetime.
class Variables {
 public:
  explicit Variables(std::map<std::string, std::string> values) : values_(std::move(values)) {
    for (const auto& [name, value] : values_) setenv(name.c_str(), value.c_str(), 1);
  }
  ~Variables() {
    for (const auto& [name, value] : values_) unsetenv(name.c_str());
  }
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;

 private:
  std::map<std::string, std::string> values_;
};

/// One of two processes on this machine, with the variables of torchrun.
std::unique_ptr<RunningMms> start_training(const fs::path& folder, int rank, int port) {
  const Variables variables({{"WORLD_SIZE", "2"},
                             {"RANK", std::to_string(rank)},
                             {"MASTER_ADDR", "127.0.0.1"},
                             {"MASTER_PORT", std::to_string(port)}});
  const fs::path own = folder / std::to_string(rank);  // for what it prints
  fs::create_directories(own);
  return std::make_unique<RunningMms>(
      own,
      std::vector<std::string>{"train", "-c", "../train.yaml", "-o", "../out", "--threads", "1"});
}

std::array<std::unique_ptr<RunningMms>, 2> two_trainings(const fs::path& folder, int port) {
  return {start_training(folder, 0, port), start_training(folder, 1, port)};
}

constexpr int kFirstPort = 20000;  // below those that systems give to clients
constexpr int kPorts = 9000;

int port_of_test() {
  static int calls = 0;
  return kFirstPort + (getpid() + ++calls * 1009) % kPorts;
}

TEST(Train, TwoProcessesTrainTogether) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "4"}));
  std::string text = kConfig;
  for (std::size_t at = 0; (at = text.find(" data/", at)) != std::string::npos; at += 4) {
    text.replace(at, 6, " ../data/");
  }
  folder.write("train.yaml", text);
  const auto both = two_trainings(folder.path(), port_of_test());
  const Outcome first = both[0]->wait();
  const Outcome second = both[1]->wait();
  expect_success(first);
  expect_success(second);
  expect_in("weights: ../out/weights.safetensors", first.out);
  EXPECT_EQ(second.out, "");
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "out/weights.safetensors"));
}

/// Both the one that listens and the one that looks for it.
TEST(Train, SignalEndsWaitForOtherProcesses) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  folder.write("train.yaml", kConfig);
  for (const int rank : {0, 1}) {
    SCOPED_TRACE(rank);
    const auto process = start_training(folder.path(), rank, port_of_test());
    const fs::path printed = folder.path() / std::to_string(rank) / ".stderr";
    ASSERT_TRUE(wait_until([&] {
      return fs::exists(printed) && read_file(printed).find("waiting for") != std::string::npos;
    }));
    process->send(SIGINT);
    const Outcome outcome = process->wait();
    EXPECT_EQ(outcome.exit_code, 130);
    expect_in("interrupted: not all processes have started", outcome.err);
    EXPECT_FALSE(fs::exists(folder.path() / "out"));
  }
}

/// A process is killed: the other one says so, and the training continues from the checkpoint.
TEST(Train, ContinuesAfterAProcessIsKilled) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "4"}));
  folder.write("train.yaml", R"(
network: {long_side: 128, short_side: 96}
data: [{annotations: ../data/annotations.json}]
half_precision: false
checkpoint_every: 2
schedule: {images: 100000, batch: 2}
)");
  const auto both = two_trainings(folder.path(), port_of_test());
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder.path() / "out/checkpoint.pt"); }));
  both[1]->send(SIGKILL);
  const Outcome first = both[0]->wait();
  EXPECT_EQ(first.exit_code, 1);
  expect_in("mms: process 0 of 2: another process has ended or cannot be reached", first.err);
  expect_in("the last checkpoint is whole", first.err);
  EXPECT_EQ(both[1]->wait().exit_code, 128 + SIGKILL);
  const fs::path place = folder.path() / "0";
  RunningMms again(place, {"train", "-c", "../train.yaml", "-o", "../out", "--threads", "1"});
  ASSERT_TRUE(wait_until([&] {
    return fs::exists(place / ".stderr") &&
           read_file(place / ".stderr").find("loss") != std::string::npos;
  }));
  again.send(SIGINT);
  const Outcome outcome = again.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  expect_in("interrupted: the same command continues from the last checkpoint", outcome.err);
}

TEST(Train, ErrorsAreOneLine) {
  if (!kHasTraining) GTEST_SKIP() << "the program was built without libtorch";
  const TempFolder folder;
  folder.write("train.yaml", "data:\n  - {annotations: none.json, splitt: x}\n");
  expect_error(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}),
               "train.yaml:2: unknown key 'data[0].splitt' (did you mean 'split'?)");
  folder.write("train.yaml", "data: {annotations: none.json}\n");
  expect_error(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}),
               "train.yaml:1: data is a group, expected a list of groups");
  folder.write("train.yaml", "data:\n  - {annotations: none.json}\n");
  expect_error(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}), "none.json: ");
  folder.write("train.yaml", "network: {size: huge}\n");
  expect_error(run_mms(folder.path(), {"train", "-c", "train.yaml", "-o", "out"}),
               "network.size is 'huge', allowed: one of nano, r18, r50");
}

}  // namespace
}  // namespace mms
