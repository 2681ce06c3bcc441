#include "mms/io/text/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <regex>

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
  return path.string() + ".tmp" + process_mark() + "_" + std::to_string(counter++);
}

}  // namespace

std::string name_without_temporary_part(const std::string& name) {
  static const std::regex kTemporary(R"((.+)\.tmp[0-9]+_[0-9]+)");
  std::smatch parts;
  return std::regex_match(name, parts, kTemporary) ? parts[1].str() : name;
}

WrittenBuffer::int_type WrittenBuffer::overflow(int_type c) {
  errno = 0;
  const int_type written = std::filebuf::overflow(c);
  const bool failed = traits_type::eq_int_type(written, traits_type::eof());
  if (failed && error_ == 0) error_ = errno;
  return written;
}

std::streamsize WrittenBuffer::xsputn(const char* bytes, std::streamsize size) {
  errno = 0;
  const std::streamsize written = std::filebuf::xsputn(bytes, size);
  if (written < size && error_ == 0) error_ = errno;
  return written;
}

AtomicFile::AtomicFile(const fs::path& path)
    : path_(destination(path)), temporary_(neighbour(path_)), stream_(&buffer_) {
  errno = 0;
  if (buffer_.open(temporary_.path(), std::ios::out | std::ios::binary | std::ios::trunc) ==
      nullptr) {
    fail(errno);
  }
}

void AtomicFile::write(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) fail(buffer_.error());
}

void AtomicFile::commit() {
  errno = 0;
  const bool closed = buffer_.close() != nullptr;
  if (!closed || !stream_) fail(buffer_.error() != 0 ? buffer_.error() : errno);
  std::error_code error;
  fs::rename(temporary_.path(), path_, error);
  if (error) fail(error.value());
  temporary_.release();
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
