#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// The depth of a room behind everything that passes through it, from a camera that stands still:
/// at every pixel the farthest depth that is measured again and again, its far mode.
class RoomDepth {
 public:
  /// Adds a depth image [m]; 0, NaN and infinite pixels are no return.
  /// @throws DataError when it has another size than the ones before.
  void add(const Image<float>& depth);

  /// Far mode at every pixel [m], 0 where nothing was measured. Of a pixel's sorted depths, runs
  /// without a gap above a twentieth of the depth are its modes; one counts from a tenth of the
  /// pixel's returns on.
  Image<float> far_mode() const;

 private:
  std::vector<Image<std::uint16_t>> millimetres_;
};

/// What moving things left in a static map.
struct GhostPointCount {
  std::size_t points = 0;        ///< of the map
  std::size_t seen = 0;          ///< of these in front of the camera, on a pixel with a room depth
  std::size_t ghost_points = 0;  ///< of these more than the margin in front of the room
  double percent = 0.0;          ///< ghost_points over points
};

/// Counts map points that stand more than `margin` [m] in front of the room's own depth at their
/// pixel. The camera stands at the origin of the map's world.
GhostPointCount evaluate_ghost_points(std::span<const Eigen::Vector3f> map,
                                      const Image<float>& room_depth,
                                      const CameraIntrinsics& camera, double margin = 0.15);

/// points, seen, ghost_points, ghost_percent.
std::vector<MetricValue> metric_values(const GhostPointCount& ghost_points);

}  // namespace mms
