#include "mms/localization/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/motion_compensation.hpp"

namespace mms {
namespace {

/// Velocity kept from frame to frame while lost: people who stop before the lens do not send the
/// estimate through the wall.
constexpr double kCoasting = 0.5;

/// How far two measurements of one pose may be apart [m].
constexpr double kMeasurementError = 0.01;

constexpr double kVoxelsPerRange = 25.0;
constexpr double kMinVoxel = 0.05;  ///< [m]
constexpr double kMaxVoxel = 1.0;   ///< [m]
constexpr double kRadiusPerVoxel = 200.0;

}  // namespace

void OdometryConfig::visit(ConfigVisitor& v) {
  v.number({"voxel_size", "m", "edge of the local maps' voxels; 0 chooses it from the first frame"},
           voxel_size, {0.0, 10.0});
  v.number({"map_radius", "m", "local maps reach this far; 0 is 200 voxels"}, map_radius,
           {0.0, 1000.0});
  v.integer({"max_voxels", "", "bound on the voxels of a local map"}, max_voxels,
            {1000, 10'000'000});
  v.integer({"min_inliers", "", "a frame with fewer inlying residuals is lost"}, min_inliers,
            {6, 100000});
  v.number({"min_inlier_share", "", "a frame with a smaller share of inliers is lost"},
           min_inlier_share, {0.0, 1.0});
  v.number({"max_speed", "m/s", "a faster estimate is not believed"}, max_speed, {0.1, 1000.0});
  v.number({"max_turn_rate", "deg/s", "a faster estimate is not believed"}, max_turn_rate,
           {1.0, 36000.0});
  v.number({"max_acceleration", "m/s^2", "a faster change of the velocity is not believed"},
           max_acceleration, {0.1, 10000.0});
  v.group({"registration", "", "robust Gauss-Newton of a frame against the local maps"},
          registration);
}

Odometry::Odometry(const OdometryConfig& config, const DepthNoise& noise)
    : config_(config), keyframes_(config.registration.photometric, noise), noise_(noise) {}

OdometryEstimate Odometry::estimate(FeatureCloud measured) {
  const Timestamp stamp = measured.stamp;
  const FeatureCloud features = at_pose_time(std::move(measured));
  const std::optional<FeatureCloud> first = std::exchange(first_scan_, std::nullopt);
  OdometryEstimate estimate = maps_ ? track(features) : initialize(features);
  if (first && velocity_known_) estimate = begin_in_motion(*first, features);
  estimate.stamp = stamp;
  estimate.T_world_sensor = Transform<World, Sensor>(predict(stamp));
  return estimate;
}

/// A scan takes the time between two frames. Its pose is that of its middle, where an error of the
/// velocity that it is de-skewed with moves nothing; that of an image with depth is the image's.
FeatureCloud Odometry::at_pose_time(FeatureCloud features) const {
  const double elapsed = maps_ ? to_seconds(features.stamp - stamp_) : 0.0;
  if (!features.intensity.empty()) return at_stamp(std::move(features), velocity_, elapsed);
  deskew(features, velocity_);
  features.stamp = features.stamp + features.points_offset;
  return features;
}

OdometryEstimate Odometry::track(const FeatureCloud& features) {
  const double elapsed = to_seconds(features.stamp - stamp_);
  const Isometry prediction = predict(features.stamp);
  const RegistrationResult result = register_frame(
      features, {*maps_, keyframes_.nearest(prediction)}, prediction, config_.registration, noise_);

  OdometryEstimate estimate;
  estimate.information = result.information;
  estimate.edge_inliers = result.geometric.edges.inliers;
  estimate.plane_inliers = result.geometric.planes.inliers;
  estimate.intensity_inliers = result.intensity_inliers;
  estimate.iterations = result.iterations;
  estimate.degenerate_directions = result.degenerate_directions;
  estimate.plane_rms =
      std::sqrt(result.geometric.plane_square_sum / std::max(1, result.geometric.planes.inliers));
  if (trustworthy(features, result, prediction, elapsed)) {
    estimate.status = lost_                              ? Status::kRecovered
                      : result.degenerate_directions > 0 ? Status::kDegenerate
                                                         : Status::kTracking;
    accept(features, result.T_world_sensor, elapsed);
  } else {
    estimate.status = Status::kLost;
    coast(prediction);
  }
  stamp_ = features.stamp;
  return estimate;
}

OdometryEstimate Odometry::initialize(const FeatureCloud& features) {
  OdometryEstimate estimate;
  stamp_ = known_at_ = features.stamp;
  const auto count = features.planes.size() + features.edges.size();
  if (count < static_cast<std::size_t>(config_.min_inliers)) {
    estimate.status = Status::kLost;
    return estimate;
  }
  const double voxel =
      config_.voxel_size > 0.0
          ? config_.voxel_size
          : std::clamp(median_range(features) / kVoxelsPerRange, kMinVoxel, kMaxVoxel);
  map_radius_ = config_.map_radius > 0.0 ? config_.map_radius : kRadiusPerVoxel * voxel;
  begin_maps(voxel, features);
  if (features.intensity.empty() && features.points_offset != Duration::zero()) {
    first_scan_ = features;
  }
  return estimate;
}

void Odometry::begin_maps(double voxel, const FeatureCloud& features) {
  maps_.emplace(voxel, static_cast<std::size_t>(config_.max_voxels));
  update_maps(features);
}

/// Two scans tell the motion, which skewed both of them alike: the first one is mapped again, and
/// the second one localised again. The first frame's stamp stays the origin.
/// Both are given as measured, for nothing was known of the motion.
OdometryEstimate Odometry::begin_in_motion(FeatureCloud first, FeatureCloud second) {
  deskew(first, velocity_);
  deskew(second, velocity_);
  pose_ = se3::exp(velocity_ * to_seconds(first.points_offset));
  stamp_ = known_at_ = first.stamp;
  begin_maps(static_cast<double>(maps_->voxel_size()), first);
  return track(second);
}

std::optional<Transform<World, Sensor>> Odometry::expected(Timestamp stamp) const {
  constexpr double kSureTurnRate = 0.5;  // [rad/s]
  const bool is_sure = maps_ && !lost_ && velocity_.tail<3>().norm() < kSureTurnRate;
  if (!is_sure) return std::nullopt;
  return Transform<World, Sensor>(predict(stamp));
}

Odometry::Isometry Odometry::predict(Timestamp stamp) const {
  return pose_ * se3::exp(velocity_ * to_seconds(stamp - stamp_));
}

bool Odometry::trustworthy(const FeatureCloud& features, const RegistrationResult& result,
                           const Isometry& prediction, double elapsed) const {
  const GeometricEquations& geometric = result.geometric;
  const int inliers = geometric.edges.inliers + geometric.planes.inliers;
  const auto offered = static_cast<double>(features.edges.size() + features.planes.size());
  if (inliers + result.intensity_inliers < config_.min_inliers) return false;
  if (inliers < config_.min_inlier_share * offered) return false;
  if (!result.T_world_sensor.matrix().allFinite()) return false;
  return plausible(result.T_world_sensor, prediction, std::max(elapsed, 1e-3));
}

bool Odometry::plausible(const Isometry& pose, const Isometry& prediction, double seconds) const {
  // What nothing on wheels or legs can do is people who were taken for the world.
  const double unknown_for = std::max(seconds, seconds + to_seconds(stamp_ - known_at_));
  const double deviation = (pose.translation() - prediction.translation()).norm();
  const double limit =
      kMeasurementError + 0.5 * config_.max_acceleration * unknown_for * unknown_for;
  if (velocity_known_ && deviation > limit) return false;
  const Isometry motion = pose_.inverse() * pose;
  return motion.translation().norm() <= config_.max_speed * seconds &&
         se3::angle(motion) <= config_.max_turn_rate * M_PI / 180.0 * seconds;
}

void Odometry::accept(const FeatureCloud& features, const Isometry& pose, double elapsed) {
  const Vector6d motion = se3::log(pose_.inverse() * pose);
  velocity_known_ = !lost_ && elapsed > 0.0;
  velocity_ = velocity_known_ ? Vector6d(motion / elapsed) : Vector6d(Vector6d::Zero());
  pose_ = pose;
  known_at_ = features.stamp;
  lost_ = false;
  update_maps(features);
}

void Odometry::coast(const Isometry& pose) {
  pose_ = pose;
  velocity_ *= kCoasting;
  lost_ = true;
}

void Odometry::update_maps(const FeatureCloud& features) {
  maps_->insert(features, pose_, config_.registration.geometric.association);
  keyframes_.update(features.intensity, pose_);
  // Trimming costs a pass over the maps: only when the sensor has moved on.
  if ((pose_.translation() - trimmed_at_.translation()).norm() > 0.1 * map_radius_) {
    maps_->remove_farther_than(pose_.translation().cast<float>(), static_cast<float>(map_radius_));
    trimmed_at_ = pose_;
  }
}

}  // namespace mms
