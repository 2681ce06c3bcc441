#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mms/ros/ros_messages.hpp"

namespace mms::msg {

/// nav_msgs/MapMetaData
struct MapMetaData {
  Timestamp map_load_time;
  float resolution = 0.0F;  ///< [m]
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Pose origin;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.map_load_time, self.resolution, self.width, self.height, self.origin);
  }
};

/// nav_msgs/OccupancyGrid
struct OccupancyGrid {
  Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.header, self.info, self.data);
  }
};

/// Request of nav2_msgs/LoadMap.
struct LoadMapRequest {
  std::string map_url{};  ///< a path, or file:// before it

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.map_url);
  }
};

/// Reply of nav2_msgs/LoadMap.
struct LoadMapReply {
  enum Result : std::uint8_t {
    kSuccess = 0,
    kDoesNotExist = 1,
    kInvalidData = 2,
    kUndefinedFailure = 255
  };

  OccupancyGrid map{};  ///< empty: a map file has surfaces, no occupancy
  std::uint8_t result = kUndefinedFailure;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {  ///< see wire.hpp
    archive(self.map, self.result);
  }
};

}  // namespace mms::msg
