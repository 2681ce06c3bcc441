#include "mms/io/text/output_folder.hpp"

#include <gtest/gtest.h>

#include <array>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

constexpr std::array<std::string_view, 2> kOwn = {"map.ply", "pictures"};

TEST(OutputFolder, IsMadeOrTakenIfEmpty) {
  const TempFolder folder;
  EXPECT_TRUE(take_output_folder(folder.path() / "a/b", kOwn, false));
  EXPECT_TRUE(fs::is_directory(folder.path() / "a/b"));
  EXPECT_FALSE(take_output_folder(folder.path() / "a/b", kOwn, false));
}

TEST(OutputFolder, KeepsEarlierOutputsUnlessAsked) {
  const TempFolder folder;
  folder.write("map.ply", "old");
  folder.write("pictures/1.png", "old");
  expect_in("has earlier results, as map.ply (replace them with --overwrite",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, false); }));
  EXPECT_EQ(read_file(folder.path() / "map.ply"), "old");
  EXPECT_FALSE(take_output_folder(folder.path(), kOwn, true));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(OutputFolder, NeverTouchesOtherFiles) {
  const TempFolder folder;
  folder.write("map.ply", "old");
  folder.write("mine.txt", "mine");
  expect_in("has a file that this command does not write, as mine.txt",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, true); }));
  folder.write("a.txt", "mine");
  expect_in("has 2 files that this command does not write, as a.txt",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, true); }));
  EXPECT_EQ(read_file(folder.path() / "map.ply"), "old");
}

TEST(OutputFolder, LeavesDevicesAlone) {
  const TempFolder folder;
  fs::create_symlink("/dev/null", folder.path() / "map.ply");
  EXPECT_FALSE(take_output_folder(folder.path(), kOwn, true));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "map.ply"));
}

TEST(OutputFolder, RejectsFile) {
  const TempFolder folder;
  folder.write("out", "a file");
  EXPECT_THROW(take_output_folder(folder.path() / "out", kOwn, true), FileError);
}

}  // namespace
}  // namespace mms
