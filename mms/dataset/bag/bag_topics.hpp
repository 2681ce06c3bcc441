#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/ros/bag_topic.hpp"

namespace mms {

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
