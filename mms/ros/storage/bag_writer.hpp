#pragma once

#include <string>

#include "mms/ros/message_types.hpp"
#include "mms/ros/wire.hpp"

namespace mms {

/// Writes a recording of ROS messages atomically: without `finish`, there is no file.
class BagWriter {
 public:
  virtual ~BagWriter() = default;
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// Adds a message.
  /// @param recorded  time of recording, used for playback
  /// @throws FileError if it cannot be written; DataError for stamps outside the range of ROS.
  template <class Message>
  void write(const std::string& topic, Timestamp recorded, const Message& message) {
    std::string bytes(msg::encoded_size(message, format_), '\0');
    msg::encode(message, reinterpret_cast<std::uint8_t*>(bytes.data()), format_);
    write_bytes(topic, recorded, msg::message_type(msg::kName<Message>), bytes);
  }

  /// Writes the index and renames the file.
  /// @throws FileError
  virtual void finish() = 0;

 protected:
  explicit BagWriter(msg::WireFormat format) : format_(format) {}

 private:
  virtual void write_bytes(const std::string& topic, Timestamp recorded,
                           const msg::MessageType& type, std::string_view bytes) = 0;

  msg::WireFormat format_;
};

}  // namespace mms
