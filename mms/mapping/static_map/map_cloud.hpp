#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// The static map as points, for files and viewers. The vectors are parallel.
struct MapCloud {
  std::vector<Eigen::Vector3f> points;   ///< world frame [m]
  std::vector<Rgb> colors;               ///< grey of the intensity, or mid grey, without a camera
  std::vector<Eigen::Vector3f> normals;  ///< unit, towards the sensor; zero if unknown
  std::vector<int> observations;         ///< number of views that measured the point

  std::size_t size() const { return points.size(); }
};

/// A static map that can be corrected.
struct StampedMap {
  MapCloud cloud;
  std::vector<Timestamp> stamps;  ///< by point: of the last frame that measured it
  double voxel_size = 0.0;        ///< [m]
};

/// Adds the points of another map, whose frame is the same.
void append(MapCloud& map, const MapCloud& other);

/// The map with one point a voxel: means weighted by the observations, in the order of the first
/// point of each voxel.
/// @param voxel_size  side of a voxel [m]
MapCloud merged(const MapCloud& map, double voxel_size);

/// Transform from the world frame to a corrected one, of what was measured at a stamp.
using StampCorrection = std::function<Eigen::Isometry3d(Timestamp)>;

/// The map with every point moved by the correction of its stamp.
/// @param stamps  of the last frames that measured the points
MapCloud moved(MapCloud map, const std::vector<Timestamp>& stamps,
               const StampCorrection& correction);

}  // namespace mms
