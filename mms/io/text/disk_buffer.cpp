#include "mms/io/text/disk_buffer.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kFlush = std::size_t{1} << 18;  // bytes

int open_unnamed(const std::filesystem::path& folder) {
  std::string name = (folder / ".mms_XXXXXX").string();
  const int descriptor = mkstemp(name.data());
  if (descriptor >= 0) unlink(name.c_str());
  return descriptor;
}

}  // namespace

DiskBuffer::DiskBuffer(const std::filesystem::path& folder)
    : folder_(folder), descriptor_(folder.empty() ? -1 : open_unnamed(folder)) {
  next_flush_ = kFlush;
}

DiskBuffer::~DiskBuffer() {
  if (descriptor_ >= 0) close(descriptor_);
}

void DiskBuffer::append(std::string_view bytes) {
  rest_ += bytes;
  if (rest_.size() >= next_flush_ && descriptor_ >= 0) flush();
}

void DiskBuffer::flush() {
  std::size_t written = 0;
  while (written < rest_.size()) {
    const ssize_t count = pwrite(descriptor_, rest_.data() + written, rest_.size() - written,
                                 static_cast<off_t>(on_disk_ + written));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  on_disk_ += written;
  rest_.erase(0, written);
  next_flush_ = rest_.size() + kFlush;  // a full disk is not tried with every record
}

std::string DiskBuffer::read(std::size_t begin, std::size_t end) const {
  std::string bytes(std::min(end, on_disk_) - std::min(begin, on_disk_), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(begin + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw FileError(folder_.string(),
                      "a temporary file in it cannot be read: " +
                          std::string(count < 0 ? std::strerror(errno) : "it is too short"));
    }
    done += static_cast<std::size_t>(count);
  }
  const std::size_t first = std::max(begin, on_disk_) - on_disk_;
  if (end > on_disk_) bytes.append(rest_, first, end - on_disk_ - first);
  return bytes;
}

}  // namespace mms
