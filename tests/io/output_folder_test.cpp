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

constexpr std::array<std::string_view, 3> kOwn = {"map.ply", "pictures", "run.json"};
constexpr std::array<std::string_view, 1> kMarks = {"run.json"};

TEST(OutputFolder, IsMadeOrTakenIfEmpty) {
  const TempFolder folder;
  EXPECT_TRUE(take_output_folder(folder.path() / "a/b", kOwn, kMarks, false));
  EXPECT_TRUE(fs::is_directory(folder.path() / "a/b"));
  EXPECT_FALSE(take_output_folder(folder.path() / "a/b", kOwn, kMarks, false));
}

TEST(OutputFolder, KeepsEarlierOutputsUnlessAsked) {
  const TempFolder folder;
  folder.write("map.ply", "old");
  folder.write("run.json", "{}");
  folder.write("pictures/1.png", "old");
  expect_in("has earlier results, as map.ply (replace them with --overwrite",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, kMarks, false); }));
  EXPECT_EQ(read_file(folder.path() / "map.ply"), "old");
  EXPECT_FALSE(take_output_folder(folder.path(), kOwn, kMarks, true));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(OutputFolder, ReplacesTemporaryFilesOfAKilledProcess) {
  const TempFolder folder;
  folder.write("run.json", "{}");
  folder.write("map.ply.tmp10052_4", "half");
  EXPECT_FALSE(take_output_folder(folder.path(), kOwn, kMarks, true));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  for (const char* name : {"mine.txt.tmp10052_4", "map.ply.tmp", "map.ply.tmp1_2x"}) {
    const TempFolder other;
    other.write("run.json", "{}");
    other.write(name, "mine");
    expect_in(std::string("has a file that this command did not write, as ") + name,
              message_of<FileError>([&] { take_output_folder(other.path(), kOwn, kMarks, true); }));
  }
}

TEST(OutputFolder, NeverTouchesOtherFiles) {
  const TempFolder folder;
  folder.write("map.ply", "old");
  folder.write("run.json", "{}");
  folder.write("mine.txt", "mine");
  expect_in("has a file that this command did not write, as mine.txt",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, kMarks, true); }));
  folder.write("a.txt", "mine");
  expect_in("has 2 files that this command did not write, as a.txt",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, kMarks, true); }));
  EXPECT_EQ(read_file(folder.path() / "map.ply"), "old");
}

/// A folder of pictures, without a file that only this program writes, is somebody else's.
TEST(OutputFolder, NeverTouchesFilesThatOnlyHaveTheSameName) {
  const TempFolder folder;
  folder.write("pictures/holiday.jpg", "mine");
  expect_in("has a file that this command did not write, as pictures",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, kMarks, true); }));
  EXPECT_EQ(read_file(folder.path() / "pictures/holiday.jpg"), "mine");
}

TEST(OutputFolder, NeverTouchesFileInPlaceOfFolder) {
  const TempFolder folder;
  folder.write("run.json", "{}");
  folder.write("pictures", "mine");
  expect_in("has a file that this command did not write, as pictures",
            message_of<FileError>([&] { take_output_folder(folder.path(), kOwn, kMarks, true); }));
  EXPECT_EQ(read_file(folder.path() / "pictures"), "mine");
}

/// Else a run on a network folder could not be repeated after a power cut.
TEST(OutputFolder, LeavesRemaindersOfRemovedFilesAlone) {
  for (const char* name :
       {".nfs00000000013a4d7800000002", ".fuse_hidden0000a4d700000002", ".mms_Xk3a9Q"}) {
    const TempFolder folder;
    folder.write("run.json", "{}");
    folder.write(name, "rest");
    EXPECT_FALSE(take_output_folder(folder.path(), kOwn, kMarks, true)) << name;
    EXPECT_EQ(list_folder(folder.path()), std::vector<std::string>{name});
    EXPECT_FALSE(take_output_folder(folder.path(), kOwn, kMarks, false)) << name;
  }
}

TEST(OutputFolder, LeavesDevicesAlone) {
  const TempFolder folder;
  fs::create_symlink("/dev/null", folder.path() / "map.ply");
  EXPECT_FALSE(take_output_folder(folder.path(), kOwn, kMarks, true));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "map.ply"));
}

TEST(FolderLock, KeepsOthersAway) {
  const TempFolder folder;
  const fs::path path = folder.path() / "a/b";
  {
    const FolderLock lock(path);
    EXPECT_TRUE(lock.made());
    expect_in("is in use by another mms", message_of<FileError>([&] { FolderLock second(path); }));
  }
  EXPECT_FALSE(FolderLock(path).made());
}

TEST(FolderLock, NoticesReplacedFolder) {
  const TempFolder folder;
  const fs::path path = folder.path() / "a";
  const FolderLock lock(path);
  EXPECT_TRUE(lock.holds(path));
  fs::rename(path, folder.path() / "b");
  EXPECT_FALSE(lock.holds(path));
  EXPECT_TRUE(lock.holds(folder.path() / "b"));
  fs::create_directory(path);
  EXPECT_FALSE(lock.holds(path));
}

TEST(OutputFolder, RejectsFile) {
  const TempFolder folder;
  folder.write("out", "a file");
  EXPECT_THROW(take_output_folder(folder.path() / "out", kOwn, kMarks, true), FileError);
}

}  // namespace
}  // namespace mms
