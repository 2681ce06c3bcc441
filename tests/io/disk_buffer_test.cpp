#include "mms/io/text/disk_buffer.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <string>

#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::TempFolder;

constexpr std::size_t kMegabyte = 1'000'000;

/// Lets no file of this process grow beyond a size during its lifetime, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

/// Appends lines of numbers, about 3 MB.
std::string fill(DiskBuffer& buffer, std::size_t& most_in_memory) {
  std::string all;
  for (int i = 0; i < 400'000; ++i) {
    const std::string line = std::to_string(i) + "\n";
    buffer.append(line);
    all += line;
    most_in_memory = std::max(most_in_memory, buffer.in_memory());
  }
  return all;
}

TEST(DiskBuffer, KeepsAllBytesInOrderButFewInMemory) {
  const TempFolder folder;
  DiskBuffer buffer(folder.path());
  std::size_t most_in_memory = 0;
  const std::string all = fill(buffer, most_in_memory);
  EXPECT_EQ(buffer.size(), all.size());
  EXPECT_TRUE(buffer.read() == all);
  const std::size_t on_disk = all.size() - buffer.in_memory();
  for (const std::size_t begin : {std::size_t{0}, on_disk - 3, on_disk, on_disk + 2}) {
    const std::size_t end = begin + 5;
    EXPECT_EQ(buffer.read(begin, end), all.substr(begin, end - begin));
  }
  EXPECT_LT(most_in_memory, kMegabyte / 2);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the file has no name";
}

TEST(DiskBuffer, KeepsInMemoryWhatTheDiskDoesNotTake) {
  const TempFolder folder;
  DiskBuffer buffer(folder.path());
  std::size_t most_in_memory = 0;
  std::string all;
  {
    const FileSizeLimit limit(kMegabyte);
    all = fill(buffer, most_in_memory);
  }
  EXPECT_GT(most_in_memory, kMegabyte);
  EXPECT_TRUE(buffer.read() == all);
}

TEST(DiskBuffer, NeedsNoFolder) {
  for (const std::filesystem::path folder : {"", "/nonexistent"}) {
    DiskBuffer buffer(folder);
    std::size_t most_in_memory = 0;
    const std::string all = fill(buffer, most_in_memory);
    EXPECT_TRUE(buffer.read() == all);
  }
}

}  // namespace
}  // namespace mms
