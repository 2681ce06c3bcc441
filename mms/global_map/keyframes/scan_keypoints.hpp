#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/global_map/keyframes/keyframe_record.hpp"

namespace mms {

/// The frame of the floor below a LiDAR keyframe, in its sensor frame: z is up, the floor at 0, x
/// the sensor's forward direction. Level where no floor is found.
/// @param points  of the static surroundings, sensor frame [m]
/// @param up      assumed direction of up, sensor frame
Eigen::Isometry3d floor_frame(const std::vector<Eigen::Vector3f>& points,
                              const Eigen::Vector3d& up);

/// ORB keypoints of the density image of the static surroundings. Those that are similar to others
/// in the same image, as the posts of shelves are, identify no place and are left out.
/// @param points          as for `floor_frame`
/// @param T_sensor_floor  of `floor_frame`
/// @returns points are on the floor in the sensor frame; pixels are x and y in the floor's frame
/// [m]
ImageKeypoints extract_scan_keypoints(std::vector<Eigen::Vector3f> points,
                                      const Eigen::Isometry3d& T_sensor_floor);

}  // namespace mms
