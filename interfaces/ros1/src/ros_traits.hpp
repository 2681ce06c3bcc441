#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>

#include "mms/ros/display_messages.hpp"
#include "mms/ros/message_types.hpp"
#include "mms/ros/wire.hpp"

// Defines the traits that roscpp requires of message types. (Debian's generated headers of ROS 1
// messages do not compile as C++20.)

namespace mms {

/// std_srvs/Trigger
struct TriggerRequest {
  template <class Self, class Archive>
  static void fields(Self&, Archive&) {}
};
struct TriggerResponse {
  bool success = false;
  std::string message;

  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.success, self.message);
  }
};

template <class Message>
struct WireSerializer {
  template <class Stream>
  static void write(Stream& stream, const Message& message) {
    msg::encode(message, stream.advance(serializedLength(message)));
  }
  template <class Stream>
  static void read(Stream& stream, Message& message) {
    const std::string_view bytes(reinterpret_cast<const char*>(stream.getData()),
                                 stream.getLength());
    message = msg::decode<Message>(bytes, "message");
    stream.advance(stream.getLength());
  }
  static std::uint32_t serializedLength(const Message& message) {
    return static_cast<std::uint32_t>(msg::encoded_size(message));
  }
};

template <class Message>
struct TypeTrait {
  static const msg::MessageType& type() { return msg::message_type(msg::kName<Message>); }
};

}  // namespace mms

#define MMS_TEXT_TRAIT(TRAIT, TYPE, TEXT)                  \
  template <>                                              \
  struct TRAIT<TYPE> {                                     \
    static const char* value() { return TEXT; }            \
    static const char* value(const TYPE&) { return TEXT; } \
  };

#define MMS_ROS_MESSAGE(TYPE)                                                       \
  namespace ros::message_traits {                                                   \
  template <>                                                                       \
  struct IsMessage<TYPE> : TrueType {};                                             \
  MMS_TEXT_TRAIT(MD5Sum, TYPE, mms::TypeTrait<TYPE>::type().md5.c_str())            \
  MMS_TEXT_TRAIT(DataType, TYPE, mms::TypeTrait<TYPE>::type().name.c_str())         \
  MMS_TEXT_TRAIT(Definition, TYPE, mms::TypeTrait<TYPE>::type().definition.c_str()) \
  }                                                                                 \
  namespace ros::serialization {                                                    \
  template <>                                                                       \
  struct Serializer<TYPE> : mms::WireSerializer<TYPE> {};                           \
  }

MMS_ROS_MESSAGE(mms::msg::Image)
MMS_ROS_MESSAGE(mms::msg::CompressedImage)
MMS_ROS_MESSAGE(mms::msg::CameraInfo)
MMS_ROS_MESSAGE(mms::msg::PointCloud2)
MMS_ROS_MESSAGE(mms::msg::Odometry)
MMS_ROS_MESSAGE(mms::msg::Transforms)
MMS_ROS_MESSAGE(mms::msg::Path)
MMS_ROS_MESSAGE(mms::msg::MarkerArray)
MMS_ROS_MESSAGE(mms::msg::DiagnosticArray)
MMS_ROS_MESSAGE(mms::msg::Masks)
MMS_ROS_MESSAGE(mms::msg::Objects)

namespace ros::service_traits {
MMS_TEXT_TRAIT(MD5Sum, mms::TriggerRequest, "937c9679a518e3a18d831e57125ea522")
MMS_TEXT_TRAIT(MD5Sum, mms::TriggerResponse, "937c9679a518e3a18d831e57125ea522")
MMS_TEXT_TRAIT(DataType, mms::TriggerRequest, "std_srvs/Trigger")
MMS_TEXT_TRAIT(DataType, mms::TriggerResponse, "std_srvs/Trigger")
}  // namespace ros::service_traits

namespace ros::message_traits {
MMS_TEXT_TRAIT(MD5Sum, mms::TriggerRequest, "d41d8cd98f00b204e9800998ecf8427e")
MMS_TEXT_TRAIT(MD5Sum, mms::TriggerResponse, "937c9679a518e3a18d831e57125ea522")
MMS_TEXT_TRAIT(DataType, mms::TriggerRequest, "std_srvs/TriggerRequest")
MMS_TEXT_TRAIT(DataType, mms::TriggerResponse, "std_srvs/TriggerResponse")
}  // namespace ros::message_traits

namespace ros::serialization {
template <>
struct Serializer<mms::TriggerRequest> : mms::WireSerializer<mms::TriggerRequest> {};
template <>
struct Serializer<mms::TriggerResponse> : mms::WireSerializer<mms::TriggerResponse> {};
}  // namespace ros::serialization

#undef MMS_TEXT_TRAIT
#undef MMS_ROS_MESSAGE
