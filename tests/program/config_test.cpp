#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Outcome check(const TempFolder& folder, const std::string& settings) {
  folder.write("settings.yaml", settings);
  return run_mms(folder.path(), {"config", "check", "settings.yaml"});
}

TEST(Config, DumpIsValidAndRoundTrips) {
  const TempFolder folder;
  const Outcome dumped = run_mms(folder.path(), {"config", "dump"});
  expect_success(dumped);
  for (const char* group :
       {"fusion:", "features:", "odometry:", "keyframes:", "static_map:", "dynamic_map:"}) {
    expect_in(group, dumped.out);
  }
  const Outcome checked = check(folder, dumped.out);
  expect_success(checked);
  EXPECT_EQ(checked.out, "settings.yaml: valid\n");
  EXPECT_EQ(run_mms(folder.path(), {"config", "dump", "settings.yaml"}).out, dumped.out);
}

TEST(Config, DumpDocumentsEveryLine) {
  const TempFolder folder;
  const std::string text = run_mms(folder.path(), {"config", "dump"}).out;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    const std::string line = text.substr(start, end - start);
    const bool group = line.ends_with(":");
    EXPECT_TRUE(group || line.find("# ") != std::string::npos) << line;
    start = end + 1;
  }
}

TEST(Config, WrongKeyErrorNamesLineAndNearestKey) {
  const TempFolder folder;
  const Outcome outcome = check(folder, "static_map:\n  # finer\n  voxel_siz: 0.01\n");
  expect_error(outcome, "settings.yaml:3: ");
  expect_in("voxel_siz'", outcome.err);
  expect_in("did you mean 'voxel_size'?", outcome.err);
  expect_error(check(folder, "odometri:\n  voxel_size: 1\n"), "odometry");
}

TEST(Config, WrongValueErrorNamesAllowedValues) {
  const TempFolder folder;
  const Outcome range = check(folder, "static_map:\n  voxel_size: -3\n");
  expect_error(range, "settings.yaml:2: static_map.voxel_size");
  expect_in("-3", range.err);
  expect_error(check(folder, "static_map:\n  voxel_size: fine\n"), "'fine'");
  expect_error(check(folder, "fusion:\n  mode: magic\n"), "multimodal");
  expect_error(check(folder, "fusion: [1, 2\n"), "settings.yaml:");
}

TEST(Config, ErrorNamesMissingFile) {
  const TempFolder folder;
  expect_error(run_mms(folder.path(), {"config", "check", "none.yaml"}), "none.yaml: ");
  expect_error(run_mms(folder.path(), {"run", "-c", "none.yaml"}), "none.yaml: ");
}

TEST(Config, EmptyFileGivesDefaults) {
  const TempFolder folder;
  expect_success(check(folder, ""));
  expect_success(check(folder, "# nothing yet\n"));
}

}  // namespace
}  // namespace mms
