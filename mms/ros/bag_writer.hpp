#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "mms/ros/message_types.hpp"
#include "mms/ros/wire.hpp"

namespace mms {

/// Writes a ROS 1 bag atomically.
class BagWriter {
 public:
  /// @throws FileError if the file cannot be created, or the program was built without rosbag.
  explicit BagWriter(const std::filesystem::path& path);
  ~BagWriter();
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Adds a message.
  /// @param recorded  time of recording, used for playback
  /// @throws FileError if it cannot be written; DataError for stamps outside the range of ROS.
  template <class Message>
  void write(const std::string& topic, Timestamp recorded, const Message& message) {
    std::string bytes(msg::encoded_size(message), '\0');
    msg::encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()));
    write_bytes(topic, recorded, msg::message_type(msg::kName<Message>), std::move(bytes));
  }

  /// Writes the index and renames the file.
  /// @throws FileError
  void finish();

 private:
  class Impl;

  void write_bytes(const std::string& topic, Timestamp recorded, const msg::MessageType& type,
                   std::string bytes);

  std::unique_ptr<Impl> impl_;
};

}  // namespace mms
