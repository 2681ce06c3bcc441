#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mms/io/text/atomic_file.hpp"
#include "mms/ros/storage/bag_writer.hpp"

namespace mms {

/// Writes a ROS 1 bag of version 2.0 without compression, with index.
class Ros1Writer final : public BagWriter {
 public:
  /// @throws FileError if the file cannot be created.
  explicit Ros1Writer(const std::filesystem::path& path);

  void finish() override;

 private:
  struct Entry {
    Timestamp time;
    std::uint32_t offset = 0;  ///< in the chunk [B]
  };
  using Index = std::map<std::uint32_t, std::vector<Entry>>;  ///< by connection

  void write_bytes(const std::string& topic, Timestamp recorded, const msg::MessageType& type,
                   std::string_view bytes) override;
  void append(std::string_view bytes);
  void write_bag_header(std::uint64_t index_position);
  void finish_chunk();

  AtomicFile file_;
  std::uint64_t position_ = 0;  ///< bytes written to the file
  std::string chunk_;           ///< records of the current chunk
  Index index_;                 ///< of the current chunk
  std::map<std::string, std::uint32_t> connection_of_topic_;
  std::vector<std::string> connections_;  ///< their records
  std::vector<std::string> chunk_infos_;  ///< records of the chunks written
};

}  // namespace mms
