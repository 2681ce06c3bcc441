#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/registration/local_maps.hpp"

namespace mms::testing {

/// The interior of an axis-aligned box in the world frame, with exact ground truth for the
/// localization.
struct BoxRoom {
  Eigen::Vector3d low{-2.5, -1.5, -1.0};
  Eigen::Vector3d high{2.0, 1.2, 4.0};

  struct Hit {
    Eigen::Vector3d point;   ///< world frame [m]
    Eigen::Vector3d normal;  ///< unit, into the room
    int axis;                ///< the face's normal is along this axis
  };

  /// Intersection of a ray from a point inside with the room.
  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Distance of a point on a face from the nearest of the 12 creases [m].
  double distance_to_crease(const Eigen::Vector3d& point) const;

  /// Distance of a point inside from the nearest face [m].
  double distance_to_face(const Eigen::Vector3d& point) const;

  /// Nearest point on the crease that `point` is closest to.
  Eigen::Vector3d on_crease(const Eigen::Vector3d& point) const;
};

/// A smooth texture everywhere in the world, [0, 255].
double texture(const Eigen::Vector3d& world_point);

/// 160 x 120, 63 degrees wide.
CameraIntrinsics box_camera();

/// View of the room by a camera at that pose: organised, static, colored by `texture`.
/// `noise` scales the default DepthNoise; 0 is exact.
LabeledCloud organised_cloud(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor,
                             double noise = 0.0, unsigned seed = 1);

/// Scan of a spinning LiDAR of `rings` rings at that pose, with range noise [m].
LabeledCloud spinning_scan(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor, int rings,
                           double noise, unsigned seed);

/// The same with a sensor that moves during the scan of `period` [s], with the times of the
/// points. `pose` is T_world_sensor at a time since the scan's stamp [s].
LabeledCloud moving_scan(const BoxRoom& room, const std::function<Eigen::Isometry3d(double)>& pose,
                         double period, int rings, double noise, unsigned seed);

/// Exact planar features of rays in all directions, `density` to a side of each of 6 cube faces,
/// without those nearer to a crease than `margin` [m]; exact edge features along the creases.
FeatureCloud exact_features(const BoxRoom& room, const Eigen::Isometry3d& T_world_sensor,
                            int density = 20, double margin = 0.15);

/// Adds Gaussian noise to all points: along the ray of planar features, in all directions of edges.
void add_noise(FeatureCloud& features, double sigma, std::mt19937& random);

/// Moves that share of the features by up to `distance` [m] in any direction.
void add_outliers(FeatureCloud& features, double share, double distance, std::mt19937& random);

/// Name of a test with that parameter.
inline std::string association_name(const ::testing::TestParamInfo<Association>& parameter) {
  return parameter.param == Association::kPaper ? "paper" : "surface";
}

/// exp of (translation [m], rotation [rad]).
Eigen::Isometry3d motion(double x, double y, double z, double rx, double ry, double rz);

/// Distance [m] and angle [deg] between poses.
double position_error(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);
double angle_error_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

}  // namespace mms::testing
