#pragma once

#include <Eigen/Core>
#include <vector>

#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/registration/local_maps.hpp"

namespace mms {

/// An edge feature and the line it belongs to.
struct EdgeMatch {
  Eigen::Vector3d point;      ///< of the feature, in the sensor frame [m]
  Eigen::Vector3d on_line;    ///< world frame [m]
  Eigen::Vector3d direction;  ///< unit, world frame
  double sigma = 0.0;         ///< of feature and line across the line [m]
};

/// A planar feature and the plane it belongs to.
struct PlaneMatch {
  Eigen::Vector3d point;     ///< of the feature, in the sensor frame [m]
  Eigen::Vector3d on_plane;  ///< world frame [m]
  Eigen::Vector3d normal;    ///< unit, world frame
  double sigma = 0.0;        ///< of the distance between both along the normal [m]
};

struct Matches {
  std::vector<EdgeMatch> edges;
  std::vector<PlaneMatch> planes;
};

/// Data association (III-C.2) at a pose: the counterpart of every feature in the local maps.
/// Features without a valid one are left out: lines whose two points nearly coincide (the
/// denominator of eq. (3)), planes whose three points are nearly collinear (that of eq. (4)),
/// neighborhoods that are no line, normals that disagree.
/// @param gate  largest distance between a feature and its counterpart [m]
Matches associate(const FeatureCloud& features, const LocalMaps& maps,
                  const Eigen::Isometry3d& T_world_sensor, Association association, double gate);

}  // namespace mms
