#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/motion/pose_prediction.hpp"
#include "mms/localization/photometric/photometric_term.hpp"
#include "mms/localization/registration/geometric_term.hpp"

namespace mms {

struct RegistrationConfig {
  GeometricConfig geometric;
  PhotometricConfig photometric;
  int max_iterations = 30;
  int iterations_per_level = 16;
  double converged_translation = 5e-5;
  double converged_rotation = 5e-5;
  double degenerate_sigma = 0.02;

  void visit(ConfigVisitor& v);
};

/// What one frame is registered against.
struct RegistrationTarget {
  const LocalMaps& maps;
  std::vector<const IntensityKeyframe*> keyframes;  ///< empty without a photometric term
};

struct RegistrationResult {
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  ///< of the data alone
  GeometricEquations geometric;             ///< of the last iteration
  int intensity_inliers = 0;
  /// Standard deviation of the photometric residuals, mean of the keyframes [grey levels]; 0: no
  /// residuals. It adapts to the data: several times the usual one means that the pose is wrong.
  double intensity_sigma = 0.0;
  int iterations = 0;
  int degenerate_directions = 0;  ///< that the data alone do not determine
  bool converged = false;
};

/// Robust Gauss-Newton on SE(3) for eq. (5), squared: edge and plane residuals and, for images, the
/// photometric residuals of the reference keyframes in the same normal equations, from the coarsest
/// level of the intensity pyramid to the finest. A prediction with known covariance is one more
/// measurement; of one without, only the directions that the data do not determine are kept (Zhang
/// et al., ICRA 2016).
RegistrationResult register_frame(const FeatureCloud& features, const RegistrationTarget& target,
                                  const PosePrediction& prediction,
                                  const RegistrationConfig& config, const DepthNoise& noise);

}  // namespace mms
