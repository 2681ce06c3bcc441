#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/ros/bag_topic.hpp"
#include "mms/ros/wire.hpp"

namespace mms {

/// A ROS 1 bag (version 2.0, compressed chunks as well), read by its index: only the chunk that is
/// at hand is in memory. Not for several threads at once.
class BagReader {
 public:
  /// @throws FileError when the file cannot be read, or the program was built without rosbag.
  /// @throws DataError when it is no bag, is truncated or has no index; says which topics it has.
  explicit BagReader(const std::filesystem::path& path);
  ~BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// By name.
  const std::vector<BagTopic>& topics() const;

  /// Messages of a topic; 0 for one that is not there.
  std::size_t count(const std::string& topic) const;

  /// When the message was recorded. @param index  below `count`, by that time
  Timestamp received(const std::string& topic, std::size_t index) const;

  /// The message. @throws DataError when the bag is damaged there, or the message is of another
  ///         form than its type says.
  template <class Message>
  Message read(const std::string& topic, std::size_t index) const {
    return msg::decode<Message>(bytes(topic, index), where(topic, index));
  }

  /// "file.bag: /topic message 12", for errors.
  std::string where(const std::string& topic, std::size_t index) const;

 private:
  class Impl;

  /// The message's bytes, there until the next call.
  std::string_view bytes(const std::string& topic, std::size_t index) const;

  std::unique_ptr<Impl> impl_;
};

/// Whether a file is called as bags are: "x.bag", and "x.bag.active" of one that was not closed.
bool is_bag_name(const std::filesystem::path& path);

}  // namespace mms
