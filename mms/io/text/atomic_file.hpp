#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

namespace mms {

/// A file that appears whole or not at all: bytes go to a neighbour that `commit` renames. Without
/// `commit` (an exception on the way) the neighbour is removed and an older file stays as it was.
class AtomicFile {
 public:
  /// @throws FileError when the folder is missing or not writable, or `path` is no regular file.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where the bytes go, before `commit`.
  std::ostream& stream() { return stream_; }

  /// @throws FileError when any byte could not be written.
  void commit();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

/// Writes a whole file through an AtomicFile. @throws FileError as AtomicFile does.
void write_file(const std::filesystem::path& path, std::string_view bytes);
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace mms
