#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mms/ros/bag_topic.hpp"

namespace mms {

/// The topics of a bag to read; empty: to be found by their types and names, or not there.
struct BagTopicNames {
  std::string color{};  ///< sensor_msgs/Image or CompressedImage
  std::string depth{};  ///< sensor_msgs/Image or CompressedImage, registered to the colour image
  std::string cloud{};  ///< sensor_msgs/PointCloud2
  std::string camera_info{};  ///< sensor_msgs/CameraInfo of the colour image
  std::string mask{};         ///< sensor_msgs/Image of labels: 0 static, 1 person, 2 vehicle
  std::string truth{};        ///< PoseStamped, TransformStamped, Odometry or TFMessage

  bool empty() const { return *this == BagTopicNames(); }
  bool operator==(const BagTopicNames&) const = default;
};

/// Tells the encoding of an image topic, "rgb8" or "16UC1": that of its first message.
using EncodingOf = std::function<std::string(const BagTopic&)>;

/// Chooses what to read of a bag: the topics given, and for the others the likeliest. There is
/// depth or a cloud: a depth image is preferred where there is a colour image for it. Colour images
/// are told from depth images by their encoding, and preferred by their names ("color", "rgb");
/// depth images that are said to be aligned or registered come first. camera_info is the one beside
/// the colour image. Truth is only what calls itself so: ground_truth, mocap, vicon and the like.
/// @param given  topics named by the user
/// @param where  the bag, for messages
/// @throws DataError listing the topics there are, when there is neither colour with depth nor a
///         cloud, or a topic given is not there or of a type that does not fit.
BagTopicNames choose_topics(const std::vector<BagTopic>& topics, const BagTopicNames& given,
                            const EncodingOf& encoding_of, const std::string& where);

}  // namespace mms
