#pragma once

#include <array>

#include "mms/core/calibration.hpp"
#include "mms/core/config_visitor.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/geometry/sensor_noise.hpp"

namespace mms {

/// What decides whether a point is dynamic: the three rows of the paper's ablation.
enum class FusionMode {
  kMultimodal,  ///< masks and geometric clusters together (all of III-B)
  kVision,      ///< the dilated masks alone (III-B.1)
  kNone,        ///< nothing: every point is static
};

/// Planes removed before clustering, so that a person is not connected with the floor below or the
/// wall behind. `min_extent` exceeds the width over which a torso (radius 0.17 m) is flat within
/// `tolerance`; `max_masked_share` detects flat sides of masked objects.
struct PlaneRemoval {
  double min_area = 0.05;         ///< [m^2]
  double min_extent = 0.2;        ///< along the shorter principal axis [m]
  double min_share = 0.02;        ///< of the valid points
  double tolerance = 0.02;        ///< distance of a point on the plane, before noise [m]
  double noise_factor = 2.5;      ///< sigmas of depth noise added to `tolerance`
  double max_normal_angle = 0.4;  ///< between point and plane normal [rad]
  double max_masked_share = 0.3;  ///< of a plane under masks; above, it is an object's flat side
  int max_planes = 6;
  void visit(ConfigVisitor& v);

  /// Distance at which a point with noise `sigma` [m] is still on a plane [m].
  float distance_limit(float sigma) const {
    return static_cast<float>(tolerance) + static_cast<float>(noise_factor) * sigma;
  }
};

/// Largest box of one object of a class [m]: `length` along its longest side, `width` along the
/// other two. Parts behind each other are together at most `depth` times as deep as the larger side
/// towards the sensor: a forklift's mast stands behind its engine, but an object far behind a small
/// robot is not part of it.
struct ObjectSize {
  double length = 2.3;
  double width = 1.2;
  double depth = 1.0;
  void visit(ConfigVisitor& v);
};

/// Settings of the multi-modal fusion (III-B).
struct FusionConfig {
  FusionMode mode = FusionMode::kMultimodal;

  int stride = 0;          ///< image pixels a side of the block that makes one cloud point; 0: by
                           ///< the size of the images, see `stride_of`
  double min_range = 0.3;  ///< [m]
  double max_range = 10.0;

  double dilation = 0.005;  ///< radius as a share of the image width (authors: 6 px of 1280)

  int cluster_stride = 2;           ///< cloud points a side that share one node for clustering
  double cluster_tolerance = 0.10;  ///< gap that ends a cluster, before noise [m]
  double fine_tolerance = 0.03;     ///< gap that ends a continuous surface, before noise [m]
  double noise_factor = 2.0;        ///< sigmas of depth noise added to distances between points
  int min_points = 20;              ///< nodes of the smallest cluster
  int max_points = 100000;          ///< nodes of the largest cluster

  double dynamic_share = 0.9;   ///< of labelled nodes that makes a cluster dynamic
  double partial_share = 0.3;   ///< the same for clusters of the size of one object
  double instance_share = 0.2;  ///< of an instance's nodes that make a piece split off it
  double contact_share = 0.1;   ///< of a smaller piece's nodes that may touch what it is split from
  double division_share = 0.2;  ///< of a cluster's nodes under a mask that makes it an object
  double division_distance = 0.25;  ///< across the floor between the objects of one cluster [m]
  double relabel_radius = 0.10;     ///< "close" and "nearby" of III-B.2, before noise [m]

  bool plausibility = true;  ///< whether masks that cannot be objects in 3D are dropped
  double memory = 0.5;       ///< how long an object stays dynamic without a mask [s]

  double lidar_max_range = 100.0;  ///< [m]
  double lidar_voxel = 0.10;       ///< [m]
  double lidar_tolerance = 0.30;   ///< [m]

  SensorNoise noise{};  ///< no setting of its own: `SystemConfig::noise`
  PlaneRemoval planes;
  std::array<ObjectSize, kObjectClassCount> sizes{
      {{.length = 2.3, .width = 1.2, .depth = 1.0}, {.length = 4.0, .width = 2.5, .depth = 1.5}}};

  /// Stride for images of a camera: that of the settings, or the least with which they have no more
  /// points than the method was tuned for.
  int stride_of(const CameraIntrinsics& camera) const;

  void visit(ConfigVisitor& v);
};

}  // namespace mms
