#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/odometry_estimate.hpp"
#include "mms/localization/features/feature_cloud.hpp"
#include "mms/localization/motion/motion_model.hpp"
#include "mms/localization/odometry_config.hpp"
#include "mms/localization/photometric/reference_keyframes.hpp"
#include "mms/localization/photometric/still_camera.hpp"
#include "mms/localization/registration/registration.hpp"

namespace mms {

/// Features of an earlier frame at their place.
struct PlacedFeatures {
  FeatureCloud features;
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
};

/// Localization (III-C): keeps the local maps and estimates the pose of every frame against them.
class Odometry {
 public:
  Odometry(const OdometryConfig& config, const DepthNoise& noise);

  /// A frame registered against the local maps, which it has not changed yet.
  struct Alignment {
    Timestamp stamp;                                 ///< of the frame
    FeatureCloud features;                           ///< at the time of the pose
    std::optional<RegistrationResult> registration;  ///< nothing before the first frame
    bool is_valid = false;                           ///< whether the frame is not lost
    bool looks_right = true;  ///< whether the photometric residuals spread as usual
    /// Of the sensor during a scan [m/s, rad/s], where the expected one does not de-skew it.
    std::optional<Vector6d> velocity{};
  };

  /// Estimates a frame's pose. The frames must come in the order of their stamps.
  Alignment align(FeatureCloud features) const;

  /// How well features fit to the local maps and reference keyframes.
  struct Fit {
    int inliers = 0;  ///< edges and planes within three standard deviations of their counterparts
    /// Of the photometric residuals [grey levels]; 0 without images or keyframes in view.
    double intensity_sigma = 0.0;
  };

  /// The fit of an image's features at a pose, which is not changed. After the first frame.
  /// @param features  at the time of the pose
  Fit fit(const FeatureCloud& features, const Eigen::Isometry3d& T_world_sensor) const;

  /// Takes an alignment of the next frame: moves the sensor and updates the local maps.
  /// Never throws for bad frames: see Status.
  OdometryEstimate accept(Alignment alignment);

  /// Continues at a place where the sensor was recognized after it was lost; after `restart`, new
  /// local maps begin there with the last frame.
  /// @param surroundings  added to the local maps, which may not reach there
  /// @returns the estimate of that frame, with status kRecovered
  OdometryEstimate relocate(Timestamp stamp, const Transform<World, Sensor>& T_world_sensor,
                            const std::vector<PlacedFeatures>& surroundings);

  /// Begins anew with the next frame: new local maps from the pose that is predicted now. For a
  /// sensor that is lost where the local maps do not reach.
  void restart();

  /// Whether there are no local maps yet.
  bool begins() const { return !maps_; }

  /// Whether a frame has enough features for local maps to begin with.
  bool can_begin_with(const FeatureCloud& features) const;

  OdometryEstimate estimate(FeatureCloud features) { return accept(align(std::move(features))); }

  /// Adds measurements of wheels and gyroscope up to the end of the next frame.
  /// @param is_camera  whether the frames are images
  void sense(const MotionSamples& samples, const MotionCalibration& calibration, bool is_camera) {
    motion_.sense(samples, calibration, is_camera);
  }

  /// Whether the photometric residuals of the last frame spread as usual.
  bool looks_right() const { return looks_right_; }

  /// What was found about wheels and gyroscope since the last call, one line each.
  std::vector<std::string> take_warnings() { return motion_.take_warnings(); }

  /// Of the sensor in its own frame between two times [m/s, rad/s]: as measured by wheels or
  /// gyroscope, or between the last two poses; zero until two frames were tracked.
  Vector6d velocity(Timestamp from, Timestamp to) const { return motion_.velocity(from, to); }

  /// Of the sensor during the last scan, where it was not the expected one; see `Alignment`.
  const std::optional<Vector6d>& unexpected_velocity() const { return unexpected_velocity_; }

  /// Whether the last scan gave the velocity that skewed the first one, so that a map made of the
  /// first one is wrong.
  bool begins_anew() const { return begins_anew_; }

  /// Of the sensor, between the last two poses [rad/s].
  double turn_rate() const { return motion_.velocity().tail<3>().norm(); }

  /// Pose expected at `stamp`, at constant velocity without wheels and gyroscope; nothing before
  /// the first frame, when lost for too long, and in fast turns, which the last velocity does not
  /// predict.
  std::optional<Transform<World, Sensor>> expected(Timestamp stamp) const;

  /// The same for images of which all features are known. Where the last turns differ, so that the
  /// next one may, it is the pose that fits these features, if nearly all of them fit: then hardly
  /// anything moves.
  std::optional<Transform<World, Sensor>> expected(const FeatureCloud& features) const;

 private:
  using Isometry = Eigen::Isometry3d;

  FeatureCloud at_pose_time(FeatureCloud features) const;
  Alignment align_scan(const FeatureCloud& measured) const;
  std::optional<Vector6d> changed_velocity(const Alignment& alignment) const;
  OdometryEstimate initialize(const FeatureCloud& features);
  Alignment align_at_pose_time(FeatureCloud features) const;
  void hold_still(Alignment& alignment) const;
  OdometryEstimate track(const Alignment& alignment);
  OdometryEstimate begin_in_motion(FeatureCloud first, FeatureCloud second);
  void make_maps(const FeatureCloud& features);
  void coarsen_maps(const FeatureCloud& features);
  void update_maps(const FeatureCloud& features);

  OdometryConfig config_;
  std::optional<LocalMaps> maps_;  ///< made from the first frame, whose range sets the voxels
  FeatureCloud last_features_;     ///< of the last frame, at the time of its pose
  std::optional<FeatureCloud> first_scan_;  ///< as measured, until the second one
  ReferenceKeyframes keyframes_;
  StillCamera still_camera_;
  DepthNoise noise_;
  double map_radius_ = 0.0;
  int far_scans_ = 0;  ///< in a row whose automatic voxels are much larger than the maps'
  MotionModel motion_;
  Isometry origin_ = Isometry::Identity();  ///< pose of the frame that the local maps began with
  Isometry trimmed_at_ = Isometry::Identity();
  double turn_change_ = 0.0;            ///< from the turn before the last to the last one [rad]
  double usual_intensity_sigma_ = 0.0;  ///< running mean of `intensity_sigma` [grey levels]
  bool lost_ = false;
  bool looks_right_ = true;
  std::optional<Vector6d> unexpected_velocity_;
  bool begins_anew_ = false;
};

}  // namespace mms
