#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/ros/storage/bag_writer.hpp"
#include "mms/storage/compression.hpp"

namespace mms::testing {

/// A message as a recorder stores it.
struct SerializedMessage {
  std::string topic;
  std::string type;  ///< "sensor_msgs/msg/Image"
  Timestamp recorded;
  std::string bytes;
};

/// Collects serialized messages for the functions below.
class MessageList final : public BagWriter {
 public:
  explicit MessageList(msg::WireFormat format = msg::WireFormat::kCdr) : BagWriter(format) {}
  void finish() override {}
  const std::vector<SerializedMessage>& messages() const { return messages_; }

 private:
  void write_bytes(const std::string& topic, Timestamp recorded, const msg::MessageType& type,
                   std::string_view bytes) override {
    std::string name = type.name;
    name.insert(name.find('/'), "/msg");
    messages_.push_back({topic, name, recorded, std::string(bytes)});
  }
  std::vector<SerializedMessage> messages_;
};

/// What the .db3 files of rosbag2 differ in.
struct Db3Options {
  int schema = 4;                ///< 1 to 4
  bool zstd_messages = false;    ///< each message compressed
  std::string encoding = "cdr";  ///< as said in its topics
};

/// Writes a database as rosbag2 does.
void write_db3(const std::filesystem::path& path, const std::vector<SerializedMessage>& messages,
               const Db3Options& options = {});

/// What MCAP files of other writers differ in.
struct McapOptions {
  bool chunks = true;
  std::string compression = "lz4";  ///< "" for none
  bool indexes = true;              ///< of messages after each chunk
  bool summary = true;              ///< false: ends after the last chunk, as after a power cut
  std::string encoding = "cdr";     ///< as said in its channels
  std::size_t messages_per_chunk = 3;
};

/// An MCAP file, independent of our own writer.
std::string mcap_bytes(const std::vector<SerializedMessage>& messages,
                       const McapOptions& options = {});

/// Five images, a pose and a transform, of about 100 bytes each.
void write_sample(BagWriter& bag);

}  // namespace mms::testing
