#pragma once

#include "mms/core/config_visitor.hpp"
#include "mms/geometry/normal_equations.hpp"
#include "mms/localization/registration/data_association.hpp"

namespace mms {

struct GeometricConfig {
  Association association = Association::kSurface;
  bool edges = true;
  bool planes = true;
  double gate = 2.0;           ///< [voxels]
  double initial_scale = 0.5;  ///< [voxels]
  double map_sigma = 0.004;    ///< [m]
  double robust_scale = 2.0;
  double weight = 0.5;

  void visit(ConfigVisitor& v);
};

struct GeometricEquations {
  NormalEquations edges;
  NormalEquations planes;

  int inliers() const { return edges.inliers + planes.inliers; }
  GeometricEquations& operator+=(const GeometricEquations& other);
};

/// Number of the features that take part.
double offered(const FeatureCloud& features, const GeometricConfig& config);

/// Normal equations of eqs. (3) and (4) at a pose: every residual weighted by the inverse variance
/// of the measurement and the map, and by Cauchy's robust weight. Inliers lie within three sigma.
/// @param annealed_scale  standard deviation [m] that the pose error adds to the residuals; widens
///                        the robust weight while the pose is inaccurate
GeometricEquations geometric_equations(const Matches& matches,
                                       const Eigen::Isometry3d& T_world_sensor,
                                       const GeometricConfig& config, double annealed_scale = 0.0);

}  // namespace mms
