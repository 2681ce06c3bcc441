#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/ros/bag/bag_topic.hpp"

namespace mms {

/// Returns the encoding of an image topic, such as "rgb8" or "16UC1", from its first message; of
/// compressed images the format, such as "jpeg", empty if it cannot be read.
using EncodingOf = std::function<std::string(const BagTopic&)>;

/// Selects the topics to read: the given ones, and the best match for the others. Depth with a
/// color image is preferred to a cloud. Color and depth images are distinguished by encoding; names
/// with "color" or "rgb", and depth called aligned or registered, are preferred. camera_info is
/// that of the color image, whose name also decides among equal depth images. Ground truth must be
/// named so: ground_truth, mocap, vicon etc.
/// @param given  topics named by the user
/// @param where  the bag, for messages
/// @throws DataError with the available topics if there is neither color with depth nor a cloud,
/// there are several depth cameras of equal rank, or a given topic is missing or has a wrong type.
BagTopicNames choose_topics(const std::vector<BagTopic>& topics, const BagTopicNames& given,
                            const EncodingOf& encoding_of, const std::string& where);

/// Topic of the camera_info beside a topic of images: "/rgb/camera_info" for "/rgb/image".
std::string camera_info_beside(const std::string& topic);

/// Whether the name of a topic of depth images says that they are registered to color images, as
/// drivers name it: "aligned_depth_to_color", "depth_registered".
bool is_named_registered(const std::string& depth_topic);

}  // namespace mms
