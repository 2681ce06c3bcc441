#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mms {

/// Bytes that are collected in a hidden temporary file, so that the memory of a long run does not
/// grow. While the file cannot be written, as on a full disk, they stay in memory.
class DiskBuffer {
 public:
  /// @param folder  for the file; empty: all stays in memory
  explicit DiskBuffer(const std::filesystem::path& folder = {});
  ~DiskBuffer();
  DiskBuffer(const DiskBuffer&) = delete;
  DiskBuffer& operator=(const DiskBuffer&) = delete;

  void append(std::string_view bytes);  ///< also on a full disk

  std::size_t size() const { return on_disk_ + rest_.size(); }  ///< [B]
  std::size_t in_memory() const { return rest_.size(); }        ///< of them [B]

  /// All bytes, in order. @throws FileError if the file cannot be read
  std::string read() const { return read(0, size()); }

  /// The bytes in [begin, end), at most `size()`. @throws as `read`
  std::string read(std::size_t begin, std::size_t end) const;

 private:
  void flush();

  std::filesystem::path folder_;
  int descriptor_ = -1;  ///< none without a file
  std::size_t on_disk_ = 0;
  std::string rest_;  ///< those that are not on disk
  std::size_t next_flush_;
};

}  // namespace mms
