#pragma once

#include <vector>

#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/motion/motion_model.hpp"
#include "mms/localization/odometry_config.hpp"
#include "mms/localization/photometric/reference_keyframes.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

/// Registers one frame from several first guesses and chooses among the results.
class RegistrationChoice {
 public:
  /// What a frame is registered with; all of it is used, not kept.
  struct Inputs {
    const FeatureCloud& features;       ///< at the time of the pose
    const FeatureCloud& last_features;  ///< of the frame before
    const LocalMaps& maps;
    const ReferenceKeyframes& keyframes;
    const MotionModel& motion;
    const OdometryConfig& config;
    const DepthNoise& noise;
    double usual_intensity_sigma;  ///< of frames before [grey levels]; 0: unknown
  };

  explicit RegistrationChoice(const Inputs& inputs)
      : features_(inputs.features),
        last_features_(inputs.last_features),
        maps_(inputs.maps),
        keyframes_(inputs.keyframes),
        motion_(inputs.motion),
        config_(inputs.config),
        noise_(inputs.noise),
        usual_intensity_sigma_(inputs.usual_intensity_sigma) {}

  RegistrationResult best() const;

  /// Whether enough features agree, and the sensor can have moved so.
  bool is_valid(const RegistrationResult& result) const;

  /// Whether the photometric residuals spread as usual.
  bool looks_right(const RegistrationResult& result) const;

 private:
  RegistrationResult register_sensed(const PosePrediction& prediction) const;
  RegistrationResult register_predicted(const PosePrediction& prediction) const;
  RegistrationResult register_far(RegistrationResult best, const PosePrediction& prediction) const;
  RegistrationResult register_turned(RegistrationResult best) const;
  RegistrationResult register_stopped(RegistrationResult best,
                                      const PosePrediction& prediction) const;
  std::vector<Eigen::Isometry3d> turn_guesses(bool at_predicted_place) const;
  RegistrationResult register_near(const PosePrediction& prediction,
                                   const RegistrationConfig& config) const;

  const FeatureCloud& features_;
  const FeatureCloud& last_features_;
  const LocalMaps& maps_;
  const ReferenceKeyframes& keyframes_;
  const MotionModel& motion_;
  const OdometryConfig& config_;
  const DepthNoise& noise_;
  double usual_intensity_sigma_;
};

}  // namespace mms
