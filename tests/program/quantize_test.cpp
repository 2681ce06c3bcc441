#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests

constexpr const char* kWeights = MMS_SOURCE_DIR "/weights/nano.safetensors";

nlohmann::json results_of(const TempFolder& folder, const std::string& weights) {
  expect_success(run_mms(folder.path(), {"segment", "data/images", "--weights", weights,
                                         "--json-only", "-o", weights + ".found"}));
  return nlohmann::json::parse(read_file(folder.path() / (weights + ".found") / "results.json"));
}

/// Every confident object is among the others, with its image, class and score. Those at the
/// lowest score may differ.
void expect_among(const nlohmann::json& objects, const nlohmann::json& others) {
  std::size_t confident = 0;
  for (const nlohmann::json& object : objects) {
    if (object["score"] < 0.25) continue;
    ++confident;
    EXPECT_TRUE(std::any_of(others.begin(), others.end(),
                            [&](const nlohmann::json& other) {
                              return other["image_id"] == object["image_id"] &&
                                     other["category_id"] == object["category_id"] &&
                                     std::abs(other["score"].get<double>() -
                                              object["score"].get<double>()) < 0.03;
                            }))
        << object["image_id"] << ", " << object["score"];
  }
  EXPECT_GE(confident, 4U);
}

/// A file with int8 weights is half as large and gives the same objects.
TEST(Quantize, WritesFloatOrInt8Weights) {
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "4"}));
  const auto quantize = [&](const char* output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"quantize", kWeights, "--data",      "data/images",
                                          "-o",       output,   "--long-side", "192"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_mms(folder.path(), arguments);
    expect_success(outcome);
    expect_in("calibrated on 4 images", outcome.out);
    return fs::file_size(folder.path() / output);
  };
  const auto floats = quantize("floats", {});
  const auto bytes = quantize("bytes", {"--int8-weights", "--float-layers", "backbone.conv1"});
  EXPECT_LT(bytes, 0.55 * static_cast<double>(floats));
  const nlohmann::json expected = results_of(folder, "floats");
  const nlohmann::json found = results_of(folder, "bytes");
  expect_among(expected, found);
  expect_among(found, expected);
}

TEST(Quantize, ErrorsAreOneLine) {
  const TempFolder folder;
  expect_success(
      run_mms(folder.path(), {"simulate", "training-set", "-o", "data", "--images", "1"}));
  expect_error(run_mms(folder.path(), {"quantize", kWeights, "--data", "none", "-o", "out"}),
               "none: ");
  expect_error(run_mms(folder.path(), {"quantize", kWeights, "--data", "data/images", "-o", "out",
                                       "--float-layers", "no.such"}),
               "has no convolution 'no.such'");
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace mms
