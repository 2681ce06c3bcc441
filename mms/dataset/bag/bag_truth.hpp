#pragma once

#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/ros/bag/bag_reader.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// All transforms of /tf and /tf_static, or of the other transform topics.
/// @param warnings  receives the messages that cannot be read
TransformTree read_transforms(const BagReader& bag, std::vector<std::string>& warnings);

/// Poses of a topic of PoseStamped, TransformStamped, Odometry, or transforms; the latter as poses
/// of the sensor's frame in the root of the tree. Skips poses whose stamps do not increase.
/// @param sensor_frame  frame_id of the images or clouds
/// @param warnings  receives the messages that cannot be read
/// @throws DataError if the transforms do not contain the sensor.
Trajectory read_truth(const BagReader& bag, const std::string& topic,
                      const TransformTree& transforms, const std::string& sensor_frame,
                      std::vector<std::string>& warnings);

}  // namespace mms
