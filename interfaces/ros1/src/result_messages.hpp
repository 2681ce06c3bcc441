#pragma once

#include <string>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"
#include "mms/pipeline/frame_result.hpp"
#include "mms/ros/display_messages.hpp"

namespace mms {

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

}  // namespace mms
