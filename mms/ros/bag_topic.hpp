#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mms {

/// A topic of a bag.
struct BagTopic {
  std::string name;       ///< "/camera/color/image_raw"
  std::string type;       ///< "sensor_msgs/Image"
  std::size_t count = 0;  ///< of messages
};

/// "/a sensor_msgs/Image (12), /b ..." for messages; "no topics" if there are none.
std::string listed(const std::vector<BagTopic>& topics);

}  // namespace mms
