#include "mms/dataset/open_dataset.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/dataset/recording.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::string error_of(const std::filesystem::path& path) {
  const std::string message = message_of<DataError>([&] { open_dataset(path); });
  expect_in(path.string() + ": ", message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

TEST(OpenDataset, ErrorNamesFoundAndExpectedFiles) {
  const TempFolder folder;
  expect_in("is empty: no recording found (expected rgb.txt and depth.txt",
            error_of(folder.path()));
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) folder.write(name, "");
  expect_in("has a, b, c, d and 2 more: no recording found", error_of(folder.path()));
  expect_in("no such recording", error_of(folder.path() / "missing"));
  expect_in("is a file; a recording is a folder", error_of(folder.path() / "a"));
}

TEST(OpenDataset, SuggestsRecordingInSubfolder) {
  const TempFolder folder;
  folder.write("seq/rgb.txt", "");
  expect_in("did you mean " + (folder.path() / "seq").string() + "?", error_of(folder.path()));
}

TEST(OpenDataset, RejectsVelodyneFolderWithoutScans) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "velodyne");
  expect_in("has no *.bin scans", error_of(folder.path()));
}

TEST(OpenDataset, OpensSimulations) {
  EXPECT_EQ(open_dataset("sim:static?frames=3&width=64")->size(), 3U);
}

}  // namespace
}  // namespace mms
