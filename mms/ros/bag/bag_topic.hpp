#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mms {

/// A topic of a recording.
struct BagTopic {
  std::string name;       ///< "/camera/color/image_raw"
  std::string type;       ///< "sensor_msgs/Image", in ROS 2 too; "Log (json)" if it cannot be read
  std::size_t count = 0;  ///< of messages
};

/// "/a sensor_msgs/Image (12), /b ..." for messages; "no topics" if there are none.
std::string listed(const std::vector<BagTopic>& topics);

}  // namespace mms
