#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"

namespace mms {

/// Exact points in the world frame [m]; the vectors are parallel, optional ones may be empty.
struct TruthCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Rgb> colors;
  std::vector<std::int32_t> labels;  ///< 0 static, else 1 + id of the object
};

}  // namespace mms
