#include "mms/io/text/atomic_file.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

TEST(AtomicFile, WritesAndReplaces) {
  const TempFolder folder;
  const auto path = folder.path() / "a.txt";
  write_file(path, "one");
  EXPECT_EQ(read_file(path), "one");
  write_file(path, "two");
  EXPECT_EQ(read_file(path), "two");
  EXPECT_EQ(list_folder(folder.path()), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, KeepsOldFileWithoutCommit) {
  const TempFolder folder;
  const auto path = folder.write("a.txt", "old");
  {
    AtomicFile file(path);
    file.stream() << "half";
  }
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(list_folder(folder.path()).size(), 1U);
}

TEST(AtomicFile, FollowsLinks) {
  const TempFolder folder;
  const auto target = folder.write("target.txt", "old");
  const auto link = folder.path() / "link.txt";
  std::filesystem::create_symlink(target, link);
  write_file(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_file(target), "new");
}

TEST(AtomicFile, ErrorsNameFile) {
  const TempFolder folder;
  const auto missing = folder.path() / "no" / "a.txt";
  const std::string message = message_of<FileError>([&] { write_file(missing, "x"); });
  expect_in(missing.string() + ": cannot be written: No such file or directory", message);
  message_of<FileError>([&] { write_file(folder.path(), "x"); });
  message_of<FileError>([] { write_file("/dev/null", "x"); });
}

TEST(Files, ErrorsNameFile) {
  const TempFolder folder;
  const auto missing = folder.path() / "a.txt";
  expect_in(missing.string() + ": no such file",
            message_of<FileError>([&] { read_file(missing); }));
  message_of<FileError>([&] { read_file(folder.path()); });
  message_of<FileError>([] { read_file("/dev/zero"); });
  message_of<FileError>([&] { list_folder(missing); });
}

TEST(Files, ReadsEmptyFiles) {
  const TempFolder folder;
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
}

}  // namespace
}  // namespace mms
