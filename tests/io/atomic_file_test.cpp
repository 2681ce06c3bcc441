#include "mms/io/text/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

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

/// Processes in two containers may have one number, and write one file.
TEST(AtomicFile, TemporaryNamesHaveMoreThanTheNumberOfTheProcess) {
  const TempFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  const std::vector<std::string> names = list_folder(folder.path());
  ASSERT_EQ(names.size(), 1U);
  const std::string own = "a.txt.tmp" + std::to_string(::getpid());
  EXPECT_TRUE(names.front().starts_with(own)) << names.front();
  EXPECT_FALSE(names.front().starts_with(own + "_")) << names.front();
  EXPECT_EQ(name_without_temporary_part(names.front()), "a.txt");
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

TEST(AtomicFile, SignalsRemoveTemporaryFiles) {
  const TempFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  const TemporaryPath below(folder.path() / "below");
  std::filesystem::create_directory(below.path());
  const TemporaryPath inner(below.path() / "b.txt");
  folder.write("below/b.txt", "half");
  write_file(folder.path() / "c.txt", "whole");
  EXPECT_EQ(list_folder(folder.path()).size(), 3U);
  remove_temporary_paths();
  EXPECT_EQ(list_folder(folder.path()), std::vector<std::string>{"c.txt"});
}

/// A disk that is full is noticed while the stream is written, before `commit`.
TEST(AtomicFile, ErrorsNameCauseOfEarlierWrites) {
  const TempFolder folder;
  void (*handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 100;
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of<FileError>([&] {
    AtomicFile file(folder.path() / "a.txt");
    file.stream() << std::string(100000, 'x');
    errno = 0;
    file.commit();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expect_in("a.txt: cannot be written: File too large", message);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
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
