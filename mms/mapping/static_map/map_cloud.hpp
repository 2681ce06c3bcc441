#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// The static map as points, for files and viewers. The vectors are parallel.
struct MapCloud {
  std::vector<Eigen::Vector3f> points;   ///< world frame [m]
  std::vector<Rgb> colors;               ///< mid grey for points without a color
  std::vector<Eigen::Vector3f> normals;  ///< unit, towards the sensor; zero where unknown
  std::vector<int> observations;         ///< number of views that measured the point

  std::size_t size() const { return points.size(); }
};

}  // namespace mms
