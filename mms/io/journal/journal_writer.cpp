#include "mms/io/journal/journal_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mms/core/error.hpp"

namespace mms {

JournalWriter::JournalWriter(const std::filesystem::path& path, const JournalHeader& header)
    : path_(path) {
  constexpr mode_t kMode = 0666;  // minus the umask
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, kMode);
  if (descriptor_ < 0) fail(errno);
  try {
    write(encode_header(header));
  } catch (...) {
    ::close(descriptor_);
    ::unlink(path.c_str());  // useless without a header
    throw;
  }
}

JournalWriter::~JournalWriter() {
  ::close(descriptor_);
}

void JournalWriter::append(const JournalFrame& frame) {
  write(encode_frame(frame));
}

void JournalWriter::remove() noexcept {
  struct stat own {};
  struct stat there {};
  const bool same = ::fstat(descriptor_, &own) == 0 && ::stat(path_.c_str(), &there) == 0 &&
                    own.st_dev == there.st_dev && own.st_ino == there.st_ino;
  if (same) ::unlink(path_.c_str());
}

void JournalWriter::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void JournalWriter::fail(int error_number) const {
  throw FileError(path_.string(), std::string("cannot be written: ") + std::strerror(error_number),
                  "check that the folder is writable and has space");
}

}  // namespace mms
