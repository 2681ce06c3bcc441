#include "mms/ros/storage/input_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "mms/core/error.hpp"

namespace mms {
namespace fs = std::filesystem;

InputFile::InputFile(const fs::path& path, std::string name) : name_(std::move(name)) {
  std::error_code error;
  if (!fs::exists(path, error)) throw FileError(name_, "no such file");
  if (!fs::is_regular_file(path, error)) throw FileError(name_, "is not a regular file");
  size_ = fs::file_size(path);
  if (size_ == 0) throw DataError(name_, "is empty, 0 bytes");
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw FileError(name_, std::string("cannot be read: ") + std::strerror(errno));
  }
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

std::string_view InputFile::view(std::uint64_t offset, std::uint64_t size) {
  if (offset > size_ || size > size_ - offset) {
    throw DataError(name_, std::to_string(size) + " bytes are missing at byte " +
                               std::to_string(std::min(offset, size_)));
  }
  if (size > kMaxBlock) {
    throw DataError(name_, "a block of " + std::to_string(size) + " bytes, allowed: up to " +
                               std::to_string(kMaxBlock));
  }
  if (offset < buffer_offset_ || offset + size > buffer_offset_ + buffer_.size()) {
    constexpr std::uint64_t kMinRead = 4096;  // several small records with one read
    fill(offset, static_cast<std::size_t>(std::min(std::max(size, kMinRead), size_ - offset)));
  }
  return std::string_view(buffer_).substr(static_cast<std::size_t>(offset - buffer_offset_),
                                          static_cast<std::size_t>(size));
}

void InputFile::fill(std::uint64_t offset, std::size_t size) {
  buffer_.resize(size);
  buffer_offset_ = offset;
  for (std::size_t done = 0; done < size;) {
    const auto got =
        ::pread(descriptor_, buffer_.data() + done, size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      buffer_.clear();
      throw FileError(name_, "cannot be read at byte " + std::to_string(offset + done) + ": " +
                                 (got == 0 ? "it got shorter" : std::strerror(errno)));
    }
    done += static_cast<std::size_t>(got);
  }
}

}  // namespace mms
