#include "mms/io/text/atomic_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "mms/core/error.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Resolves links, so that writing keeps them.
fs::path destination(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  // Renaming over /dev/null would replace the device.
  if (!fs::is_regular_file(status)) {
    throw FileError(path.string(), "cannot be written: it is not a regular file");
  }
  return fs::canonical(path);
}

fs::path neighbour(const fs::path& path) {
  static std::atomic<int> counter = 0;
  return path.string() + ".tmp" + std::to_string(::getpid()) + "_" + std::to_string(counter++);
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path)
    : path_(destination(path)), temporary_(neighbour(path_)) {
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
  errno = 0;
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) fail(errno);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_) fail(errno);
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void AtomicFile::fail(int error_number) const {
  const std::string reason = error_number == 0 ? "unknown cause" : std::strerror(error_number);
  throw FileError(path_.string(), "cannot be written: " + reason,
                  "check that the folder exists, is writable and has space");
}

void write_file(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  write_file(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace mms
