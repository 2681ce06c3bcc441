#pragma once

#include "mms/ros/storage/chunked_file.hpp"
#include "mms/ros/storage/ros1_records.hpp"

namespace mms {

/// A ROS 1 bag of version 2.0, with chunks compressed by bz2, lz4 or not at all. A bag that was not
/// closed is read up to its end.
class Ros1Bag final : public ChunkedFile {
 public:
  /// @param name  of the file in messages
  /// @throws FileError if it cannot be read; DataError if it is not a bag of version 2.0.
  Ros1Bag(const std::filesystem::path& path, const std::string& name);

 private:
  std::uint64_t walk_record(std::uint64_t offset) override;
  void scan_record(ByteReader& records, const StoredMessage& at, bool messages) override;
  std::string_view message_of(std::string_view record, const std::string& where) override;

  void add_chunk(const Ros1Fields& header, std::uint64_t data, std::uint64_t size);
  void add_index(const Ros1Fields& header, std::string_view data);
  void add_connection(const Ros1Fields& header, std::string_view data);

  std::uint64_t missing_ = 0;  ///< announced records after the chunks that did not come yet
};

}  // namespace mms
