#include "apps/mms/batch/batch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <sstream>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/temporary_path.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 5> kParts = {"runs", "unfinished", "claims", "failed",
                                                    "logs"};

/// Refuses a folder with files in which no batch was begun.
void check_is_batch(const fs::path& folder) {
  if (!fs::exists(folder) || fs::exists(folder / "claims")) return;
  if (fs::is_directory(folder) && fs::is_empty(folder)) return;
  throw FileError(folder.string(), "is not empty and has no batch", "choose a new folder with -o");
}

/// The time now, as the file system of a folder has it.
fs::file_time_type time_in(const fs::path& folder) {
  const fs::path file = folder / ("." + process_mark());
  write_file(file, std::string_view());
  const fs::file_time_type now = fs::last_write_time(file);
  fs::remove(file);
  return now;
}

}  // namespace

BatchFolder::BatchFolder(const fs::path& folder) : folder_(folder) {
  check_is_batch(folder);
  make_folder(folder);
  for (const std::string_view part : kParts) make_folder(folder / part);
  begin_ = time_in(folder / "claims");
}

BatchFolder::Claim::~Claim() {
  std::error_code ignored;
  fs::remove(file_, ignored);  // while it is locked, see `claim`
  close(descriptor_);
}

/// The file of a claim that ended is removed: one that was opened before and locked after that is
/// not the file of that name any more, and the run is done.
std::unique_ptr<BatchFolder::Claim> BatchFolder::claim(const std::string& name) const {
  const fs::path file = folder_ / "claims" / name;
  constexpr int kMode = 0644;
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode);
  if (descriptor < 0) throw FileError(file.string(), "cannot be written");
  struct stat opened {};
  struct stat there {};
  const bool is_locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  const bool is_current = fstat(descriptor, &opened) == 0 && stat(file.c_str(), &there) == 0 &&
                          opened.st_ino == there.st_ino;
  if (is_locked && is_current) return std::make_unique<Claim>(file, descriptor);
  close(descriptor);
  return nullptr;
}

bool BatchFolder::has_finished(const std::string& name) const {
  return fs::exists(results(name));
}

bool BatchFolder::has_failed(const std::string& name) const {
  return !has_finished(name) && fs::exists(failure(name));
}

bool BatchFolder::has_failed_meanwhile(const std::string& name) const {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(failure(name), error);
  return !error && time >= begin_;
}

void BatchFolder::finish(const std::string& name) const {
  fs::rename(unfinished(name), results(name));
  std::error_code ignored;
  fs::remove(failure(name), ignored);
}

void BatchFolder::fail(const std::string& name) const {
  write_file(failure(name), std::string_view());
}

std::string BatchFolder::last_words(const std::string& name) const {
  std::error_code error;
  if (!fs::exists(log(name), error)) return "";
  std::string last;
  std::istringstream text(read_file(log(name)));
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace mms
