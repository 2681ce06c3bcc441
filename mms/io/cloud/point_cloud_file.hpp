#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Content of a PLY or PCD file. The vectors are parallel to `points`, or empty if absent.
struct PointCloudFile {
  std::vector<Eigen::Vector3f> points;   ///< [m]; may be NaN or infinite
  std::vector<Eigen::Vector3f> normals;  ///< properties nx ny nz
  std::vector<Rgb> colors;               ///< properties red green blue
  std::vector<std::int32_t>
      labels;  ///< property label; ground-truth maps: 0 static, else object id
  std::vector<std::int32_t>
      observations;                   ///< property observations: frames that observed the point
  std::vector<float> intensities{};   ///< property intensity; of the sensor, or [0, 1] in maps
  std::vector<float> time_offsets{};  ///< property time: relative to the scan's stamp [s]
};

/// Removes points whose position is not finite, as PCL marks missing returns, and sets normals that
/// are not finite to zero, which means none.
/// @returns the number of removed points
std::size_t remove_invalid_points(PointCloudFile& cloud);

}  // namespace mms
