#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/ros/wire.hpp"

namespace mms {

/// A topic of one file of a recording.
struct StoredTopic {
  std::string name;  ///< "/camera/color/image_raw"
  std::string type;  ///< "sensor_msgs/Image", in ROS 2 too; "Log (json)" for messages in another
                     ///< encoding, which cannot be read
  msg::WireFormat format = msg::WireFormat::kRos1;
};

/// Where a message is.
struct StoredMessage {
  Timestamp received{};      ///< time of recording
  std::uint32_t topic = 0;   ///< index in BagContents::topics
  std::uint32_t chunk = 0;   ///< number of its chunk, if the format has chunks
  std::uint64_t offset = 0;  ///< in the chunk or the file [B], or its row in a database
};

/// What is in one file of a recording.
struct BagContents {
  std::string layout;                   ///< "ROS 1 bag", "MCAP", "rosbag2 database"
  std::vector<StoredTopic> topics;      ///< a name may occur several times
  std::vector<StoredMessage> messages;  ///< in the order of the file
  std::string damage;                   ///< where and how it is damaged; empty for a whole file
};

/// One file of a recording of ROS messages, in any format.
class BagStorage {
 public:
  virtual ~BagStorage() = default;

  virtual const BagContents& contents() const = 0;

  /// The serialized message, valid until the next call.
  /// @throws DataError at `where` if it is damaged; FileError if the file cannot be read.
  virtual std::string_view read(const StoredMessage& message, const std::string& where) = 0;
};

/// The ROS 1 name of a ROS 2 type: "sensor_msgs/Image" of "sensor_msgs/msg/Image".
inline std::string short_type(std::string type) {
  constexpr std::string_view kPart = "/msg";
  const std::size_t at = type.find("/msg/");
  return at == std::string::npos ? type : type.erase(at, kPart.size());
}

}  // namespace mms
