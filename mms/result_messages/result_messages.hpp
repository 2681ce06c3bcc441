#pragma once

#include <string>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/ros/display_messages.hpp"
#include "mms/ros/robot_frame.hpp"

namespace mms {

/// Frames in messages: map -> world -> robot.
struct FrameNames {
  std::string map;
  std::string world;
  RobotFrame::Pose robot;
};

/// Pose of the frame of the global map in the map frame of messages: x forward, y left, z up, level
/// as far as the first sensor frame of the map is.
/// @param is_camera  whether the global map has the axes of a camera
Eigen::Isometry3d level_map_pose(bool is_camera);

/// Poses of the robot, or the sensor alone, in the world frame and, once the place in the map is
/// known, of the world frame in the map frame.
/// @param header  its frame is replaced
msg::Transforms transforms_message(const msg::Header& header, const FrameNames& frames,
                                   const FrameResult& result, bool is_camera);

/// Pose with its covariance from the odometry's information; without velocities.
msg::Odometry odometry_message(const msg::Header& header, const std::string& child_frame,
                               const OdometryEstimate& odometry);

/// Points of one label, in the sensor frame, with colors if available.
msg::PointCloud2 cloud_message(const msg::Header& header, const LabeledCloud& cloud,
                               PointLabel label);

/// The static map with colors.
msg::PointCloud2 cloud_message(const msg::Header& header, const MapCloud& map);

/// 255 on P_D and masks, on the cloud's grid; empty for LiDARs.
msg::Image mask_message(const msg::Header& header, const LabeledCloud& cloud);

msg::Objects objects_message(const msg::Header& header, const std::vector<TrackedObject>& objects);

/// Boxes, red for people and green for vehicles, labeled with id, class and speed.
msg::MarkerArray markers_message(const msg::Header& header,
                                 const std::vector<TrackedObject>& objects);

/// Status of the pose, shares of dynamic points and the times of the stages.
/// @param read_ms  time to read the frame [ms]
msg::DiagnosticArray diagnostics_message(const msg::Header& header, const FrameResult& result,
                                         double read_ms);

}  // namespace mms
