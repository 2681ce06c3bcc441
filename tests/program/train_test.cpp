#include <gtest/gtest.h>

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
