#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "mms/io/text/temporary_path.hpp"

namespace mms {

/// The buffer of a file that is written, which keeps the number of the first error.
class WrittenBuffer : public std::filebuf {
 public:
  /// errno of the first write that failed; 0 if none did.
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override;                                    ///< as filebuf
  std::streamsize xsputn(const char* bytes, std::streamsize size) override;  ///< as filebuf

 private:
  int error_ = 0;
};

/// Name of the file that a temporary one of `AtomicFile` was to become, as a killed process leaves
/// it; any other name as it is.
std::string name_without_temporary_part(const std::string& name);

/// A file that is written completely or not at all: the bytes go to a temporary file next to it,
/// which `commit` renames. Without `commit` (after an exception or a signal) the temporary file is
/// removed and an existing file is unchanged.
class AtomicFile {
 public:
  /// @throws FileError if the folder is missing or not writable, or `path` is not a regular file.
  explicit AtomicFile(const std::filesystem::path& path);
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
  TemporaryPath temporary_;
  WrittenBuffer buffer_;
  std::ostream stream_;
};

/// Writes a whole file through an AtomicFile.
/// @throws FileError as AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view bytes);
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace mms
