#pragma once

#include <map>

#include "mms/ros/storage/chunked_file.hpp"
#include "mms/ros/storage/mcap_records.hpp"

namespace mms {

/// An MCAP file with messages in the formats of ROS 2 ("cdr") and ROS 1 ("ros1"), in chunks
/// compressed by zstd, lz4 or not at all, or outside of chunks; with or without index and summary.
class McapFile final : public ChunkedFile {
 public:
  /// @param name  of the file in messages
  /// @throws FileError if it cannot be read; DataError if it is not an MCAP file.
  McapFile(const std::filesystem::path& path, const std::string& name);

 private:
  std::uint64_t walk_record(std::uint64_t offset) override;
  void scan_record(ByteReader& records, const StoredMessage& at, bool messages) override;
  std::string_view message_of(std::string_view record, const std::string& where) override;
  std::string_view record_at(std::uint64_t offset) override;

  void add_chunk(std::uint64_t content, std::uint64_t size);
  void add_index(std::string_view content);
  void add_message(std::string_view content, StoredMessage at);
  void add_schema(std::string_view content);
  void add_channel(std::string_view content);
  void check_statistics(std::string_view content);
  void check_footer(std::string_view content, std::uint64_t offset);

  std::map<std::uint16_t, std::string> schemas_;  ///< names by id
};

}  // namespace mms
