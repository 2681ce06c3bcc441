#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// What a PLY or PCD file holds. The vectors are parallel to `points`, or empty when absent.
struct PointCloudFile {
  std::vector<Eigen::Vector3f> points;     ///< [m]; NaN and infinite ones are kept
  std::vector<Eigen::Vector3f> normals;    ///< property nx ny nz
  std::vector<Rgb> colors;                 ///< property red green blue
  std::vector<std::int32_t> labels;        ///< property label; truth maps: 0 static, else object id
  std::vector<std::int32_t> observations;  ///< property observations: frames that saw the point
};

}  // namespace mms
