#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "interfaces/ros1/src/node_settings.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/growing_path.hpp"
#include "mms/ros/robot_frame.hpp"

namespace mms {

/// Publishes the results of the pipeline; messages without subscribers are not created.
class ResultPublisher {
 public:
  ResultPublisher(ros::NodeHandle& node, const NodeSettings& settings);

  /// @param sensor_frame  frame_id of the images or clouds
  void publish(const Processed& processed, const SlamSystem& system,
               const std::string& sensor_frame);

  /// Clears the path.
  void reset();

 private:
  void publish_transforms(const msg::Header& world, const std::string& sensor_frame,
                          const FrameResult& result);
  void publish_path(const msg::Header& world, const FrameResult& result);
  void publish_map(const msg::Header& world, const SlamSystem& system);
  void publish_clouds(const msg::Header& sensor, const LabeledCloud& cloud);

  NodeSettings settings_;
  ros::Publisher odometry_, transforms_, path_topic_, static_cloud_, dynamic_cloud_, map_, markers_,
      objects_, mask_;
  RobotFrame robot_;
  std::vector<ros::Subscriber> robot_topics_;
  GrowingPath path_;
  ros::WallTime last_map_;
  ros::WallTime last_path_;
};

}  // namespace mms
