#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/core/time.hpp"

namespace mms {

enum class PointLabel : std::uint8_t {
  kInvalid,  ///< no return: the point's coordinates are NaN
  kStatic,   ///< static point, in P_S
  kDynamic,  ///< dynamic point, in P_D
};

/// One dynamic object in this frame (III-B.2), in the sensor frame [m].
struct DynamicCluster {
  ObjectClass object_class = ObjectClass::kPerson;  ///< of its mask
  float score = 1.0F;     ///< score of its mask, in (0, 1]; 0 without a mask
  float weight = 1.0F;    ///< how much its mask counts against what recent views saw, in (0, 1]
  double followed = 0.0;  ///< time since its mask was first seen [s]
  /// Index of its mask, -1 if unknown. If several clusters share a mask, the first is the object;
  /// the others are background or occluders under the same mask.
  int instance = -1;
  int points = 0;                                      ///< number of its points in the cloud
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< mean of its points [m]
  Eigen::Vector3f box_min = Eigen::Vector3f::Zero();   ///< axis-aligned in the sensor frame
  Eigen::Vector3f box_max = Eigen::Vector3f::Zero();   ///< opposite corner
};

/// Points of a frame with static and dynamic labels (output of III-B). The vectors are parallel.
/// Organized (RGB-D): width x height, row-major, every `stride`-th pixel of the image, points in
/// the camera frame. Unorganized (LiDAR): height 1, points in the LiDAR frame.
struct LabeledCloud {
  Timestamp stamp;                      ///< of the frame and its colors
  Duration points_offset{0};            ///< stamp of the points relative to `stamp`
  int width = 0;                        ///< columns of points
  int height = 0;                       ///< rows of points
  std::vector<Eigen::Vector3f> points;  ///< [m]
  /// Unorganized: stamp of each point relative to `stamp` [s]; empty if all are simultaneous.
  std::vector<float> time_offset;
  std::vector<PointLabel> labels;        ///< static, dynamic or no return
  std::vector<Rgb> colors;               ///< empty without an image
  std::vector<std::uint8_t> intensity;   ///< of a LiDAR, 255 at most; empty if unknown
  std::vector<std::int16_t> cluster;     ///< index into `clusters`, -1 for none
  std::vector<DynamicCluster> clusters;  ///< the dynamic objects of the frame
  int implausible_masks = 0;             ///< masks dropped, since they cannot be objects in 3D
  /// Organized: non-zero on P_D, on masks, and on the boundary around them, where colors are mixed.
  Image<std::uint8_t> dynamic_pixels;
  /// Organized: non-zero at dynamic points that are on static surfaces of recent views, so that the
  /// pose uses them. Empty without any.
  Image<std::uint8_t> overruled;
  CameraIntrinsics camera;  ///< organized: camera of the width x height grid

  /// Whether the points are a grid of an image.
  bool organised() const { return height > 1; }

  /// Organized: index of the point in column `x` and row `y`.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// Share of the valid points that are dynamic, in [0, 1]; 0 for an empty cloud.
double dynamic_share(const LabeledCloud& cloud);

/// Share of the valid points that are non-zero in `overruled`, in [0, 1]; 0 if that is empty.
double overruled_share(const LabeledCloud& cloud, const Image<std::uint8_t>& overruled);

}  // namespace mms
