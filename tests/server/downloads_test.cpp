#include "mms/server/scene/downloads.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

/// During its lifetime, temporary files are created in a folder.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const fs::path& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn() {
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
  }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;

 private:
  std::string before_;
};

/// During its lifetime, no file can be written, as on a full disk.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit none = before_;
    none.rlim_cur = 0;
    ::setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

std::shared_ptr<Scene> live_scene() {
  auto scene = std::make_shared<Scene>(testing::scene_info(true));
  scene->add(testing::frame_at(0), nullptr, nullptr);
  scene->add_map(testing::floor_map(20));
  return scene;
}

TEST(LiveDownload, IsWrittenToOwnFolder) {
  const testing::TempFolder folder;
  const TemporaryFilesIn temporary(folder.path());
  for (const std::string name : {"static_map.ply", "trajectory.tum"}) {
    const auto download = write_live_download(*live_scene(), name);
    const fs::path path = download->file.path();
    EXPECT_EQ(path.filename(), name);
    EXPECT_EQ(path.parent_path().parent_path(), folder.path());
    EXPECT_GT(fs::file_size(path), 0U);
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(LiveDownload, LeavesNoFilesOnFullDisk) {
  const testing::TempFolder folder;
  const TemporaryFilesIn temporary(folder.path());
  for (const std::string name : {"static_map.ply", "trajectory.tum"}) {
    const FullDisk full;
    EXPECT_THROW(write_live_download(*live_scene(), name), FileError) << name;
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace mms
