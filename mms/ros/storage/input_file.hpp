#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace mms {

/// Largest block that is read or decompressed as a whole: a chunk, or a message outside of chunks
/// [B].
inline constexpr std::uint64_t kMaxBlock = std::uint64_t{128} << 20U;

/// A file that is read in blocks at any position. Not thread-safe.
class InputFile {
 public:
  /// @throws FileError if it does not exist, is no regular file or cannot be read; DataError if it
  /// is empty.
  /// @param name  of the file in messages
  InputFile(const std::filesystem::path& path, std::string name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  std::uint64_t size() const { return size_; }  ///< when it was opened [B]

  /// The `size` bytes at `offset`, valid until the next call.
  /// @throws DataError if the file ends before, or the block is larger than kMaxBlock; FileError if
  /// it cannot be read.
  std::string_view view(std::uint64_t offset, std::uint64_t size);

 private:
  void fill(std::uint64_t offset, std::size_t size);

  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string buffer_;
  std::uint64_t buffer_offset_ = 0;
};

}  // namespace mms
