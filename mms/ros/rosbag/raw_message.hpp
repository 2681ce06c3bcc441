#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstring>
#include <string>

#include "mms/ros/message_types.hpp"

namespace mms {

/// A message as bytes, for which rosbag does not need the type.
struct RawMessage {
  std::string bytes;
  const msg::MessageType* type = nullptr;  ///< of a written message
};

}  // namespace mms

namespace ros::message_traits {

template <>
struct IsMessage<mms::RawMessage> : TrueType {};

template <>
struct MD5Sum<mms::RawMessage> {
  static const char* value() { return "*"; }  // any
  static const char* value(const mms::RawMessage& message) { return message.type->md5.c_str(); }
};

template <>
struct DataType<mms::RawMessage> {
  static const char* value() { return "*"; }
  static const char* value(const mms::RawMessage& message) { return message.type->name.c_str(); }
};

template <>
struct Definition<mms::RawMessage> {
  static const char* value() { return ""; }
  static const char* value(const mms::RawMessage& message) {
    return message.type->definition.c_str();
  }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <>
struct Serializer<mms::RawMessage> {
  template <class Stream>
  static void write(Stream& stream, const mms::RawMessage& message) {
    const auto size = static_cast<std::uint32_t>(message.bytes.size());
    std::memcpy(stream.advance(size), message.bytes.data(), size);
  }
  template <class Stream>
  static void read(Stream& stream, mms::RawMessage& message) {
    message.bytes.assign(reinterpret_cast<const char*>(stream.getData()), stream.getLength());
  }
  // NOLINTNEXTLINE(readability-identifier-naming): ROS calls it
  static std::uint32_t serializedLength(const mms::RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace ros::serialization
