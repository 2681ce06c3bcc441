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

TEST(OpenDataset, TakesTheRateOfRecordingsWithoutStamps) {
  const TempFolder folder;
  folder.write("calibration.yaml", kCalibration);
  for (const std::string name : {"a", "b", "c"}) {
    write_color(folder.path() / (name + ".color.png"));
    write_depth(folder.path() / (name + ".depth.png"));
    folder.write(name + ".pose.txt", "1 0 0 0.5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  const Playback played(open_dataset(folder.path(), {.rate = 12.5}));
  ASSERT_EQ(played.names(), "a b c");
  EXPECT_EQ(played.frames[0].stamp, Timestamp(0));
  EXPECT_NEAR(to_seconds(played.frames[2].stamp - Timestamp(0)), 0.16, 1e-8);
  ASSERT_EQ(played.source->ground_truth().size(), 3U);
  EXPECT_EQ(played.source->ground_truth()[2].stamp, played.frames[2].stamp);
  EXPECT_TRUE(any_has(played.source->describe(), "stamps: none, 12.5 Hz as given"));
  EXPECT_TRUE(any_has(played.source->describe(), "rate: 12.50 Hz"));
}

TEST(OpenDataset, TakesTheRateOfScansWithoutStamps) {
  const TempFolder folder;
  for (const char* name : {"000000.bin", "000001.bin"}) {
    folder.write(name, std::string(16, '\0'));
  }
  EXPECT_TRUE(
      any_has(open_dataset(folder.path())->describe(), "stamps: none, 10 Hz assumed (--rate)"));
  const Playback played(open_dataset(folder.path(), {.rate = 20.0}));
  ASSERT_EQ(played.frames.size(), 2U);
  EXPECT_EQ(played.frames[1].stamp, Timestamp(50'000'000));
}

TEST(OpenDataset, RejectsTheRateOfRecordingsWithStamps) {
  const TempFolder folder;
  write_tum(folder, 2);
  for (const std::filesystem::path& path :
       {folder.path(), std::filesystem::path("sim:static?frames=2&width=64")}) {
    expect_in("has time stamps of its own (omit --rate",
              message_of<DataError>([&] { open_dataset(path, {.rate = 10.0}); }));
  }
}

TEST(OpenDataset, OpensSimulations) {
  EXPECT_EQ(open_dataset("sim:static?frames=3&width=64")->size(), 3U);
}

}  // namespace
}  // namespace mms
