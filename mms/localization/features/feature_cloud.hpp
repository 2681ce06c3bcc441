#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// A point with large local smoothness (eq. 2), in the sensor frame.
struct EdgeFeature {
  Eigen::Vector3f point;     ///< [m]
  float sigma = 0.0F;        ///< 1-sigma measurement noise at its range [m]
  float time_offset = 0.0F;  ///< of a scan's point, from the center of the scan's time [s]
  int index = -1;            ///< of a scan's point in its cloud
};

/// A point with small local smoothness (eq. 2) and its local surface normal, in the sensor frame.
struct PlaneFeature {
  Eigen::Vector3f point;     ///< [m]
  Eigen::Vector3f normal;    ///< unit, towards the sensor
  float sigma = 0.0F;        ///< 1-sigma measurement noise along the ray at its range [m]
  float time_offset = 0.0F;  ///< of a scan's point, from the center of the scan's time [s]
  int index = -1;            ///< of a scan's point in its cloud
};

/// Luminance [0, 255] with its derivatives [1/px] by central differences.
struct IntensitySample {
  float value = 0.0F;
  float dx = 0.0F;
  float dy = 0.0F;
};

/// One level of the intensity pyramid. Depth is 0 where there is no return or the pixel is dynamic.
struct IntensityLevel {
  CameraIntrinsics camera;
  Image<IntensitySample> intensity;
  Image<float> depth;  ///< z of the static point at the pixel [m]
};

/// Input of localization from one frame: the features of the static points (III-C.1), and for RGB-D
/// the static part of the image for the photometric term.
struct FeatureCloud {
  Timestamp stamp;
  Duration points_offset{0};  ///< time of edges and planes relative to `stamp`; of a scan its
                              ///< center
  Duration half_duration{0};  ///< of a scan: from its first point to its center
  std::vector<EdgeFeature> edges;
  std::vector<PlaneFeature> planes;
  std::vector<IntensityLevel> intensity;  ///< finest first; empty without an image
};

/// Median of distances from the sensor [m]; 0 without any.
double median_range(std::vector<float> ranges);

/// That of the edges and planes.
double median_range(const FeatureCloud& features);

/// Edge of the voxels [m] where the configuration leaves it open: 1/25 of the median range [m] of a
/// frame, within 0.05 and 1 m.
double automatic_voxel_size(double median_range);

}  // namespace mms
