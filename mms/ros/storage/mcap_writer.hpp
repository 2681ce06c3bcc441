#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mms/io/text/atomic_file.hpp"
#include "mms/ros/storage/bag_writer.hpp"
#include "mms/ros/storage/mcap_records.hpp"

namespace mms {

/// Writes an MCAP file of ROS 2 messages: schemas "ros2msg", encoding "cdr", zstd chunks with
/// checksums, message indexes and a summary.
class McapWriter final : public BagWriter {
 public:
  /// @throws FileError if the file cannot be created.
  explicit McapWriter(const std::filesystem::path& path);

  void finish() override;

 private:
  struct Entry {
    std::uint64_t time = 0;    ///< [ns]
    std::uint64_t offset = 0;  ///< in the chunk [B]
  };
  using Index = std::map<std::uint16_t, std::vector<Entry>>;  ///< by channel

  void write_bytes(const std::string& topic, Timestamp recorded, const msg::MessageType& type,
                   std::string_view bytes) override;
  void append(std::string_view bytes);
  std::uint16_t channel_of(const std::string& topic, const msg::MessageType& type);
  std::uint16_t schema_of(const msg::MessageType& type);
  void finish_chunk();
  std::string statistics() const;

  AtomicFile file_;
  std::uint64_t position_ = 0;                     ///< bytes written to the file
  std::string chunk_;                              ///< records of the current chunk
  Index index_;                                    ///< of the current chunk
  std::map<std::string, std::uint16_t> schemas_;   ///< by type
  std::map<std::string, std::uint16_t> channels_;  ///< by topic
  std::string descriptions_;                       ///< records of schemas and channels
  std::vector<std::string> chunk_indexes_;         ///< records of the chunks written
  std::map<std::uint16_t, std::uint64_t> counts_;  ///< messages by channel
  std::uint64_t first_time_ = UINT64_MAX;          ///< of a message [ns]
  std::uint64_t last_time_ = 0;                    ///< of a message [ns]
};

}  // namespace mms
