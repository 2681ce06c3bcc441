#pragma once

#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/ros/bag_reader.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// All transforms of /tf and /tf_static, or of the other transform topics.
TransformTree read_transforms(const BagReader& bag);

/// Poses of a topic of PoseStamped, TransformStamped, Odometry, or transforms; the latter as poses
/// of the sensor's frame in the root of the tree. Skips poses whose stamps do not increase.
/// @param sensor_frame  frame_id of the images or clouds
/// @throws DataError if a message is damaged or the transforms do not contain the sensor.
Trajectory read_truth(const BagReader& bag, const std::string& topic,
                      const TransformTree& transforms, const std::string& sensor_frame);

}  // namespace mms
