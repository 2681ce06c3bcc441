#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/evaluation/scores/metric_value.hpp"

namespace mms {

/// Background depth of a static camera: at every pixel the farthest depth that is measured
/// repeatedly, its far mode.
class RoomDepth {
 public:
  /// @param max_pixels  of all kept images, 2 bytes each; by default those of 1000 of 640x480
  explicit RoomDepth(std::size_t max_pixels = std::size_t{1000} * 640 * 480)
      : max_pixels_(max_pixels) {}

  /// Adds a depth image [m]; 0, NaN and infinite pixels mean no return. At most 1000 images are
  /// kept, and fewer of large ones. Of more images every second one is used, of more than twice as
  /// many every fourth one, and so on.
  /// @throws DataError if its size differs from that of the earlier images.
  void add(const Image<float>& depth);

  /// Far mode at every pixel [m], 0 without returns. A mode is a run of a pixel's sorted depths
  /// without a gap above 5 % of the depth and with at least 10 % of the returns.
  Image<float> far_mode() const;

 private:
  std::size_t max_pixels_;
  std::vector<Image<std::uint16_t>> millimetres_;
  std::size_t added_ = 0;
  std::size_t step_ = 1;  ///< every so many images are kept
};

/// Points of a static map left by moving objects.
struct GhostPointCount {
  std::size_t points = 0;  ///< of the map
  std::size_t seen = 0;    ///< points in front of the camera, on a pixel with a background depth
  std::size_t ghost_points = 0;  ///< of these, more than the margin in front of the background
  double percent = 0.0;          ///< ghost_points / points
};

/// Counts map points more than `margin` [m] in front of the background depth at their pixel. The
/// camera is at the origin of the map's world frame.
GhostPointCount evaluate_ghost_points(std::span<const Eigen::Vector3f> map,
                                      const Image<float>& room_depth,
                                      const CameraIntrinsics& camera, double margin = 0.15);

/// points, seen, ghost_points, ghost_pct.
std::vector<MetricValue> metric_values(const GhostPointCount& ghost_points);

}  // namespace mms
