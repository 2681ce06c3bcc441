#pragma once

#include <string>
#include <string_view>

namespace mms::msg {

/// Type hash of ROS 2 since Iron, "RIHS01_" and 64 hexadecimal digits: the SHA-256 of a JSON text
/// of the fields (ros2/rosidl, rosidl_generator_type_description).
/// @param name        "std_msgs/msg/Header"
/// @param definition  fields in the .msg format, followed by those of the nested types as in
///                    `MessageType::ros2_definition`
/// @throws std::invalid_argument for a line that is no field, and a nested type that is missing.
std::string type_hash(std::string_view name, std::string_view definition);

/// SHA-256 (FIPS 180-4) of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace mms::msg
