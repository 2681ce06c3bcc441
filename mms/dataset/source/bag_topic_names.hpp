#pragma once

#include <string>

namespace mms {

/// Topics of a bag; an empty name selects by type and name.
struct BagTopicNames {
  std::string color{};  ///< sensor_msgs/Image or CompressedImage
  std::string depth{};  ///< sensor_msgs/Image or CompressedImage, registered to the color image
  std::string cloud{};  ///< sensor_msgs/PointCloud2, or CustomMsg of Livox's drivers
  std::string camera_info{};  ///< sensor_msgs/CameraInfo of the color image
  std::string mask{};         ///< sensor_msgs/Image of labels: 0 static, 1 person, 2 vehicle
  std::string wheels{};       ///< nav_msgs/Odometry
  std::string imu{};          ///< sensor_msgs/Imu
  std::string truth{};        ///< PoseStamped, TransformStamped, Odometry or TFMessage

  /// Whether no topic is given.
  bool empty() const { return *this == BagTopicNames(); }
  bool operator==(const BagTopicNames&) const = default;
};

}  // namespace mms
