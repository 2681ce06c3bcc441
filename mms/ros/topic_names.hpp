#pragma once

#include <string>
#include <string_view>

namespace mms::msg {

// Names of ROS 2 (design.ros2.org, "Topic and Service name mapping to DDS").

/// The full name of a topic or service: "/x" is one, "x" is in the namespace, "~/x" below the node.
/// @param where  option that the name comes from, for messages
/// @throws ConfigError for names that ROS 2 does not allow.
std::string full_topic_name(const std::string& name, const std::string& name_space,
                            const std::string& node, const std::string& where);

/// "/" or "/a/b" of a namespace with or without its first slash.
/// @throws ConfigError for names that ROS 2 does not allow.
std::string full_namespace(const std::string& name_space, const std::string& where);

/// @throws ConfigError if `name` cannot be that of a node.
void check_node_name(const std::string& name, const std::string& where);

/// "sensor_msgs::msg::dds_::Image_" of "sensor_msgs/Image", or with "srv" of its requests.
std::string dds_type_name(std::string_view type, std::string_view kind = "msg");

}  // namespace mms::msg
