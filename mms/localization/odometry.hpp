#pragma once

#include <optional>

#include "mms/core/config.hpp"
#include "mms/core/feature_cloud.hpp"
#include "mms/core/odometry_estimate.hpp"
#include "mms/localization/reference_keyframes.hpp"
#include "mms/localization/registration.hpp"

namespace mms {

struct OdometryConfig {
  RegistrationConfig registration;
  double voxel_size = 0.0;
  double map_radius = 0.0;
  int max_voxels = 200000;
  int min_inliers = 60;
  double min_inlier_share = 0.25;
  double max_speed = 30.0;
  double max_turn_rate = 720.0;
  double max_acceleration = 20.0;

  void visit(ConfigVisitor& v);
};

/// Localization (III-C): keeps the local maps and estimates the pose of every frame against them.
class Odometry {
 public:
  Odometry(const OdometryConfig& config, const DepthNoise& noise);

  /// The frames must come in the order of their stamps. Never throws for bad frames: see Status.
  OdometryEstimate estimate(FeatureCloud features);

  /// Of the sensor in its own frame [m/s, rad/s]; zero until two frames in a row were tracked.
  const Vector6d& velocity() const { return velocity_; }

  /// Where the next frame is expected, as far as the motion goes on; nothing before the first one,
  /// while lost, and in fast turns, where the motion of the last frame tells little of the next.
  std::optional<Transform<World, Sensor>> expected(Timestamp stamp) const;

 private:
  using Isometry = Eigen::Isometry3d;

  FeatureCloud at_pose_time(FeatureCloud features) const;
  OdometryEstimate initialize(const FeatureCloud& features);
  OdometryEstimate track(const FeatureCloud& features);
  OdometryEstimate begin_in_motion(FeatureCloud first, FeatureCloud second);
  void begin_maps(double voxel, const FeatureCloud& features);
  Isometry predict(Timestamp stamp) const;
  bool trustworthy(const FeatureCloud& features, const RegistrationResult& result,
                   const Isometry& prediction, double elapsed) const;
  bool plausible(const Isometry& pose, const Isometry& prediction, double seconds) const;
  void accept(const FeatureCloud& features, const Isometry& pose, double elapsed);
  void coast(const Isometry& pose);
  void update_maps(const FeatureCloud& features);

  OdometryConfig config_;
  std::optional<LocalMaps> maps_;           ///< made when the first features tell their scale
  std::optional<FeatureCloud> first_scan_;  ///< as measured, until the second one
  ReferenceKeyframes keyframes_;
  DepthNoise noise_;
  double map_radius_ = 0.0;
  Isometry pose_ = Isometry::Identity();
  Vector6d velocity_ = Vector6d::Zero();  ///< of the sensor in its own frame [m/s, rad/s]
  Isometry trimmed_at_ = Isometry::Identity();
  Timestamp stamp_;              ///< that `pose_` is of
  bool velocity_known_ = false;  ///< from two frames in a row
  Timestamp known_at_;           ///< when the pose was last measured
  bool lost_ = false;
};

}  // namespace mms
