#pragma once

#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/ros/bag_reader.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {

/// All of /tf and /tf_static, or of the other topics of transforms.
TransformTree read_transforms(const BagReader& bag);

/// Poses of a topic of PoseStamped, TransformStamped, Odometry, or of transforms, in which they are
/// those of the sensor's frame in the root of the tree. Those with stamps that do not increase are
/// left out.
/// @param sensor_frame  frame_id of the images or clouds
/// @throws DataError when a message is damaged, or the transforms say nothing of the sensor.
Trajectory read_truth(const BagReader& bag, const std::string& topic,
                      const TransformTree& transforms, const std::string& sensor_frame);

}  // namespace mms
