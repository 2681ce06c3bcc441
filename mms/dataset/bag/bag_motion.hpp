#pragma once

#include <string>
#include <vector>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/dataset/source/motion_files.hpp"
#include "mms/ros/bag/bag_reader.hpp"

namespace mms {

/// Measurements of the topics of wheels and gyroscope, but not of those for which the options name
/// a file or none. Messages whose stamps do not increase are left out and counted.
/// @param warnings  receives the messages that cannot be read
MotionRecording read_bag_motion(const BagReader& bag, const BagTopicNames& topics,
                                const MotionOptions& options, std::vector<std::string>& warnings);

}  // namespace mms
