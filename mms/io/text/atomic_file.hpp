#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

namespace mms {

/// A file that is written completely or not at all: the bytes go to a temporary file next to it,
/// which `commit` renames. Without `commit` (after an exception) the temporary file is removed and
/// an existing file is unchanged.
class AtomicFile {
 public:
  /// @throws FileError if the folder is missing or not writable, or `path` is not a regular file.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where the bytes go, before `commit`.
  std::ostream& stream() { return stream_; }

  /// Writes bytes. @throws FileError if it fails, so that a full disk is noticed early.
  void write(std::string_view bytes);

  /// @throws FileError if a write failed.
  void commit();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

/// Writes a whole file through an AtomicFile.
/// @throws FileError as AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view bytes);
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace mms
