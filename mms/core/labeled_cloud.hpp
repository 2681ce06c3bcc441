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
  kStatic,   ///< belongs to P_S
  kDynamic,  ///< belongs to P_D
};

/// One dynamic object as this frame shows it (III-B.2), in the sensor frame [m].
struct DynamicCluster {
  ObjectClass object_class = ObjectClass::kPerson;
  float score = 1.0F;  ///< of its mask, in (0, 1]; 0 without one
  /// Index of its mask; -1 where that is not known. Of several clusters under one mask the first is
  /// the object, the others are what else the mask covers.
  int instance = -1;
  int points = 0;  ///< number of cloud points it holds
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();
  Eigen::Vector3f box_min = Eigen::Vector3f::Zero();  ///< axis-aligned in the sensor frame
  Eigen::Vector3f box_max = Eigen::Vector3f::Zero();
};

/// The frame's points divided into static and dynamic ones (output of III-B). Vectors are parallel.
/// Organised (RGB-D): width x height, row-major, on every `stride`-th pixel of the image, points in
/// the camera frame. Unorganised (LiDAR): height 1, points in the LiDAR frame.
struct LabeledCloud {
  Timestamp stamp;            ///< of the frame, so of the colours
  Duration points_offset{0};  ///< when the points were measured, relative to `stamp`
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> points;  ///< [m]
  /// Unorganised: when each point was measured, since `stamp` [s]; empty where all were at once.
  std::vector<float> time_offset;
  std::vector<PointLabel> labels;
  std::vector<Rgb> colors;            ///< empty where there is no image
  std::vector<std::int16_t> cluster;  ///< index into `clusters`, -1 for none
  std::vector<DynamicCluster> clusters;
  /// Organised: non-zero where P_D or a mask is, and on the boundary about them, whose colours are
  /// mixed with theirs.
  Image<std::uint8_t> dynamic_pixels;
  CameraIntrinsics camera;  ///< organised: of the width x height grid
  bool organised() const { return height > 1; }
};

/// Share of the valid points that are dynamic, in [0, 1]; 0 for an empty cloud.
double dynamic_share(const LabeledCloud& cloud);

}  // namespace mms
