#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mms {

/// The downsampled cloud that is clustered (III-B.2: "firstly downsized"). The vectors are
/// parallel.
struct Nodes {
  int width = 0;                        ///< columns of an organised grid; 0 for a set of points
  std::vector<Eigen::Vector3f> points;  ///< [m]; NaN where an organised cell is empty
  std::vector<float> sigma;             ///< measurement noise, one sigma [m]
  std::vector<std::uint16_t> raw;       ///< 0 or 1 + instance of the mask as segmented
  std::vector<std::uint16_t> dilated;   ///< the same of the dilated mask
  std::vector<std::uint8_t> on_plane;   ///< non-zero on the ground or another removed plane

  std::size_t size() const { return points.size(); }
};

}  // namespace mms
