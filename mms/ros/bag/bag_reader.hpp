#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/ros/bag/bag_topic.hpp"
#include "mms/ros/storage/bag_storage.hpp"
#include "mms/ros/wire.hpp"

namespace mms {

/// The messages of a recording by topic: a ROS 1 bag (version 2.0), an MCAP file, a database of
/// rosbag2, or a folder of rosbag2 with several files. Only the current message or chunks are in
/// memory. Not thread-safe.
class BagReader {
 public:
  /// Opens the recording and finds its messages. Of damaged files, what is before the damage.
  /// @throws FileError if a file cannot be read; DataError if it is no recording of ROS.
  explicit BagReader(const std::filesystem::path& path);

  /// "ROS 1 bag", "MCAP", "rosbag2 database", and the number of files of several.
  const std::string& layout() const { return layout_; }

  /// Sorted by name.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// One line for each damaged or missing file.
  const std::vector<std::string>& damage() const { return damage_; }

  /// Number of messages of a topic; 0 if it is missing.
  std::size_t count(const std::string& topic) const { return messages(topic).size(); }

  /// Time of recording of a message.
  /// @param index  below `count`, in order of this time
  Timestamp received(const std::string& topic, std::size_t index) const {
    return messages(topic).at(index).stored.received;
  }

  /// The message.
  /// @throws DataError if the file is damaged there, or the message does not match its type.
  template <class Message>
  Message read(const std::string& topic, std::size_t index) const {
    return msg::decode<Message>(bytes(topic, index), where(topic, index), format(topic, index));
  }

  /// The first message of a topic that can be read.
  /// @throws DataError if none can.
  template <class Message>
  Message first(const std::string& topic) const {
    for (std::size_t i = 0; i + 1 < count(topic); ++i) {
      try {
        return read<Message>(topic, i);
      } catch (const DataError&) {  // a later one will do
      }
    }
    return read<Message>(topic, count(topic) - 1);
  }

  /// "file.bag: /topic message 12", for errors.
  std::string where(const std::string& topic, std::size_t index) const;

 private:
  struct Message {
    std::size_t file = 0;
    StoredMessage stored;
  };

  const std::vector<Message>& messages(const std::string& topic) const;
  msg::WireFormat format(const std::string& topic, std::size_t index) const;
  /// Valid until the next call.
  std::string_view bytes(const std::string& topic, std::size_t index) const;
  void add_file(std::size_t file);

  std::string name_;
  std::string layout_;
  std::vector<std::unique_ptr<BagStorage>> files_;
  std::map<std::string, std::vector<Message>, std::less<>> messages_;  ///< by topic
  std::vector<BagTopic> topics_;
  std::vector<std::string> damage_;
  mutable std::string decompressed_;  ///< the current message
};

}  // namespace mms
