#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/odometry_estimate.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"
#include "mms/global_map/keyframes/keyframe_view.hpp"
#include "mms/global_map/keyframes/scan_view.hpp"
#include "mms/global_map/places/binary_descriptor.hpp"
#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Keypoints of the static part of an image, or of a density image of LiDAR scans. The vectors are
/// parallel.
struct ImageKeypoints {
  std::vector<BinaryDescriptor> descriptors;
  std::vector<Eigen::Vector3f> points;  ///< in the sensor frame [m]
  /// In the image, as shares of its width and height; of scans, x and y on the floor [m].
  std::vector<Eigen::Vector2f> pixels;

  std::size_t size() const { return points.size(); }
};

/// What the global map keeps of a keyframe. Only static points are in it.
struct KeyframeRecord {
  Timestamp stamp;                          ///< of the frame
  std::uint32_t session = 0;                ///< number of its run; each run has a world of its own
  Transform<World, Sensor> T_world_sensor;  ///< by odometry
  bool after_lost = false;                  ///< whether the sensor was lost since the record before
  ImageKeypoints keypoints;                 ///< for place recognition
  FeatureCloud features;                    ///< edges and planes, for registration
  KeyframeView view;                        ///< small depth image
  ScanView scan;                            ///< of a LiDAR, in place of the depth image

  bool is_scan() const { return !scan.points.empty(); }

  /// Whether nothing but its pose was kept.
  bool is_pose_only() const { return features.edges.empty() && features.planes.empty(); }
};

}  // namespace mms
