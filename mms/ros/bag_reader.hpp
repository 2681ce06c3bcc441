#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/ros/bag_topic.hpp"
#include "mms/ros/wire.hpp"

namespace mms {

/// A ROS 1 bag (version 2.0, including compressed chunks), read by its index: only the current
/// chunk is in memory. Not thread-safe.
class BagReader {
 public:
  /// @throws FileError if the file cannot be read, or the program was built without rosbag.
  /// @throws DataError with the topics if it is not a bag, is truncated or has no index.
  explicit BagReader(const std::filesystem::path& path);
  ~BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// Sorted by name.
  const std::vector<BagTopic>& topics() const;

  /// Number of messages of a topic; 0 if it is missing.
  std::size_t count(const std::string& topic) const;

  /// Time of recording of a message.
  /// @param index  below `count`, in order of this time
  Timestamp received(const std::string& topic, std::size_t index) const;

  /// The message.
  /// @throws DataError if the bag is damaged there, or the message does not match its type.
  template <class Message>
  Message read(const std::string& topic, std::size_t index) const {
    return msg::decode<Message>(bytes(topic, index), where(topic, index));
  }

  /// "file.bag: /topic message 12", for errors.
  std::string where(const std::string& topic, std::size_t index) const;

 private:
  class Impl;

  /// The message's bytes, valid until the next call.
  std::string_view bytes(const std::string& topic, std::size_t index) const;

  std::unique_ptr<Impl> impl_;
};

/// Whether a file name is that of a bag: "x.bag", or "x.bag.active" of one that was not closed.
bool is_bag_name(const std::filesystem::path& path);

}  // namespace mms
