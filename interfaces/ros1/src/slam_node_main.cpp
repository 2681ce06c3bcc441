#include <ros/ros.h>

#include <exception>

#include "interfaces/ros1/src/slam_node.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "mms_slam");
  try {
    mms::SlamNode node(mms::NodeSettings::load(ros::NodeHandle("~")));
    ros::MultiThreadedSpinner(2)
        .spin();  // two threads, so that a service can wait while messages are received
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
