#pragma once

#include <string>
#include <string_view>

#include "mms/ros/ros_messages.hpp"

namespace mms::msg {

/// Identity of a ROS message type.
struct MessageType {
  std::string name;             ///< "sensor_msgs/Image"
  std::string md5;              ///< of its definition, as computed by ROS
  std::string definition;       ///< its fields and those of nested types
  std::string ros2_definition;  ///< the same for ROS 2
};

/// ROS name of a message's type.
template <class Message>
inline constexpr std::string_view kName = Message::kTypeName;
template <>
inline constexpr std::string_view kName<Float32> = "std_msgs/Float32";
template <>
inline constexpr std::string_view kName<Image> = "sensor_msgs/Image";
template <>
inline constexpr std::string_view kName<CompressedImage> = "sensor_msgs/CompressedImage";
template <>
inline constexpr std::string_view kName<CameraInfo> = "sensor_msgs/CameraInfo";
template <>
inline constexpr std::string_view kName<PointCloud2> = "sensor_msgs/PointCloud2";
template <>
inline constexpr std::string_view kName<LivoxScan> = "livox_ros_driver2/CustomMsg";
template <>
inline constexpr std::string_view kName<PoseStamped> = "geometry_msgs/PoseStamped";
template <>
inline constexpr std::string_view kName<TransformStamped> = "geometry_msgs/TransformStamped";
template <>
inline constexpr std::string_view kName<Transforms> = "tf2_msgs/TFMessage";
template <>
inline constexpr std::string_view kName<PoseWithCovarianceStamped> =
    "geometry_msgs/PoseWithCovarianceStamped";
template <>
inline constexpr std::string_view kName<Odometry> = "nav_msgs/Odometry";
template <>
inline constexpr std::string_view kName<Imu> = "sensor_msgs/Imu";

/// The type of that name.
/// @throws std::out_of_range for unknown ones.
const MessageType& message_type(std::string_view name);

}  // namespace mms::msg
