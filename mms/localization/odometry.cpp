#include "mms/localization/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/localization/registration_choice.hpp"

namespace mms {
namespace {

/// [voxels]: automatic radius of the local maps.
/// Source: eight times the median range (`automatic_voxel_size`), farther than most frames see.
constexpr double kMapRadius = 200.0;

/// [-]: passes of the photometric residuals at a pose. Source: the first gives the exposure.
constexpr int kExposurePasses = 2;

/// [-]: factor by which the automatic voxels of scans grow at least. Source: initial choice.
constexpr double kVoxelGrowth = 1.5;

/// [-]: scans in a row that call for it. Source: a second of a LiDAR, longer than the view through
/// a door.
constexpr int kMinFarScans = 10;

/// [-]: share of the map radius that the sensor moves before the maps are trimmed to it.
/// Source: computing time; the maps exceed their radius by a tenth at most.
constexpr double kTrimInterval = 0.1;

/// [rad/s]: a faster turn makes the expected pose too uncertain for motion segmentation.
/// Source: scene `fast`, whose ATE was 13.5 cm and 5 frames lost without this bound.
constexpr double kMaxExpectedTurnRate = 0.5;

/// [m]: standard deviation of the prediction up to which a lost sensor's pose is expected.
/// Source: a third of the 0.15 m by which a moving point lies in free space: three sigma.
constexpr double kMaxExpectedSigma = 0.05;

/// [m]: displacement of points at the ends of a scan, by an error of the velocity, from which on
/// the scan is de-skewed again. Source: above the 2 cm of a LiDAR's noise.
constexpr double kMinDisplacement = 0.03;

/// [-]: times that a scan is de-skewed again. Source: two to four were needed where a robot begins
/// to turn by 70 degrees/s.
constexpr int kMaxDeskewings = 4;

/// [-]: share of a frame in the usual spread of the photometric residuals.
/// Source: initial choice; ten frames are long against a fault, short against changes of the view.
constexpr double kSigmaUpdate = 0.1;

/// [-]: share of inliers from which on hardly anything moves.
/// Source: a person 3 m away covers a tenth of the view.
constexpr double kAllFit = 0.9;

/// Whether points of a scan were measured at different times.
bool is_skewed(const FeatureCloud& features) {
  return features.intensity.empty() && features.half_duration > Duration::zero();
}

/// Of the points at the ends of a scan, by a velocity or its error [m].
double displacement(const FeatureCloud& scan, const Vector6d& velocity) {
  return to_seconds(scan.half_duration) *
         (velocity.head<3>().norm() + velocity.tail<3>().norm() * median_range(scan));
}

}  // namespace

Odometry::Odometry(const OdometryConfig& config, const DepthNoise& noise)
    : config_(config),
      keyframes_(config.registration.photometric, noise),
      still_camera_(noise),
      noise_(noise),
      motion_(config.motion) {}

Odometry::Alignment Odometry::align(FeatureCloud measured) const {
  const Timestamp stamp = measured.stamp;
  Alignment alignment = is_skewed(measured) ? align_scan(measured)
                                            : align_at_pose_time(at_pose_time(std::move(measured)));
  alignment.stamp = stamp;
  return alignment;
}

/// A scan is de-skewed again as long as its pose gives another velocity.
Odometry::Alignment Odometry::align_scan(const FeatureCloud& measured) const {
  Alignment alignment = align_at_pose_time(at_pose_time(measured));
  for (int i = 0; i < kMaxDeskewings; ++i) {
    std::optional<Vector6d> velocity = changed_velocity(alignment);
    if (!velocity) break;
    // Else it would swing around the right one.
    if (alignment.velocity) velocity = 0.5 * (*velocity + *alignment.velocity);
    FeatureCloud features = measured;
    deskew(features, *velocity);
    features.stamp = alignment.features.stamp;
    Alignment again = align_at_pose_time(std::move(features));
    const bool fits_better =
        again.registration->geometric.inliers() > alignment.registration->geometric.inliers();
    if (!again.is_valid || !fits_better) break;
    alignment = std::move(again);
    alignment.velocity = velocity;
  }
  return alignment;
}

/// The velocity by the pose of a scan, if it differs so much from the one that de-skewed the scan
/// that this displaced its points.
std::optional<Vector6d> Odometry::changed_velocity(const Alignment& alignment) const {
  const FeatureCloud& features = alignment.features;
  if (!alignment.registration || first_scan_) return std::nullopt;
  if (alignment.registration->degenerate_directions > 0) return std::nullopt;
  const Isometry& pose = alignment.registration->T_world_sensor;
  if (!pose.matrix().allFinite() || motion_.predict(features.stamp).is_sensed) return std::nullopt;
  const Vector6d velocity = motion_.velocity_at(features.stamp, pose);
  const Vector6d change = velocity - alignment.velocity.value_or(motion_.velocity());
  if (displacement(features, change) < kMinDisplacement) return std::nullopt;
  return velocity;
}

Odometry::Fit Odometry::fit(const FeatureCloud& features, const Isometry& T_world_sensor) const {
  const GeometricConfig& geometric = config_.registration.geometric;
  const Matches matches = associate(features, *maps_, T_world_sensor, geometric.association,
                                    geometric.gate * maps_->voxel_size());
  Fit fit{geometric_equations(matches, T_world_sensor, geometric).inliers(), 0.0};
  if (features.intensity.empty()) return fit;
  int visible = 0;  // keyframes
  for (const IntensityKeyframe* keyframe : keyframes_.nearest(T_world_sensor)) {
    PhotometricState state;
    PhotometricEquations equations;
    for (int i = 0; i < kExposurePasses; ++i) {
      equations = photometric_equations(*keyframe, 0, features.intensity.front(), T_world_sensor,
                                        state, config_.registration.photometric, noise_);
      state = equations.next(state, config_.registration.photometric.min_sigma);
    }
    if (equations.visible == 0) continue;
    fit.intensity_sigma += state.sigma;
    ++visible;
  }
  fit.intensity_sigma /= std::max(1, visible);
  return fit;
}

OdometryEstimate Odometry::accept(Alignment alignment) {
  const std::optional<FeatureCloud> first = std::exchange(first_scan_, std::nullopt);
  OdometryEstimate estimate =
      alignment.registration ? track(alignment) : initialize(alignment.features);
  begins_anew_ = first && !lost_ && displacement(*first, motion_.velocity()) >= kMinDisplacement;
  if (begins_anew_) alignment.velocity = motion_.velocity();
  if (first && !lost_) estimate = begin_in_motion(*first, alignment.features);
  estimate.stamp = alignment.stamp;
  estimate.T_world_sensor =
      Transform<World, Sensor>(motion_.predict(alignment.stamp).T_world_sensor);
  looks_right_ = alignment.looks_right;
  unexpected_velocity_ = alignment.velocity;
  if (alignment.velocity) {
    const double seconds = to_seconds(alignment.stamp - motion_.stamp());
    estimate.T_world_sensor =
        Transform<World, Sensor>(motion_.pose() * se3::exp(*alignment.velocity * seconds));
  }
  last_features_ = std::move(alignment.features);
  return estimate;
}

Odometry::Alignment Odometry::align_at_pose_time(FeatureCloud features) const {
  Alignment alignment{features.stamp, std::move(features), {}, false};
  if (!maps_) return alignment;
  const RegistrationChoice choice({.features = alignment.features,
                                   .last_features = last_features_,
                                   .maps = *maps_,
                                   .keyframes = keyframes_,
                                   .motion = motion_,
                                   .config = config_,
                                   .noise = noise_,
                                   .usual_intensity_sigma = usual_intensity_sigma_});
  alignment.registration = choice.best();
  alignment.is_valid = choice.is_valid(*alignment.registration);
  alignment.looks_right = choice.looks_right(*alignment.registration);
  hold_still(alignment);
  return alignment;
}

/// Where the image shows that the camera stands still, its pose does not change, unless wheels or
/// gyroscope say that it moves.
void Odometry::hold_still(Alignment& alignment) const {
  const PhotometricConfig& config = config_.registration.photometric;
  if (!config.enabled || !config.hold_still) return;
  RegistrationResult& registration = *alignment.registration;
  const auto pose = still_camera_.pose(alignment.features.intensity, registration.T_world_sensor);
  if (!pose || motion_.contradiction(alignment.features.stamp, *pose)) return;
  registration.T_world_sensor = *pose;
  registration.degenerate_directions = 0;
  alignment.is_valid = alignment.looks_right = true;
}

/// A scan takes the time between two frames. Its pose is estimated at the center of that time,
/// where an error of the de-skewing velocity has no effect; that of a depth image at its stamp.
FeatureCloud Odometry::at_pose_time(FeatureCloud features) const {
  const double elapsed = maps_ ? to_seconds(features.stamp - motion_.stamp()) : 0.0;
  const Timestamp center = features.stamp + features.points_offset;
  if (!features.intensity.empty()) {
    return at_stamp(std::move(features), motion_.velocity(features.stamp, center), elapsed);
  }
  // The first two scans give the velocity themselves, see `begin_in_motion`.
  const bool begins = !maps_ || first_scan_;
  deskew(features, begins ? motion_.velocity()
                          : motion_.velocity(center - features.half_duration,
                                             center + features.half_duration));
  features.stamp = center;
  return features;
}

OdometryEstimate Odometry::track(const Alignment& alignment) {
  const FeatureCloud& features = alignment.features;
  const RegistrationResult& result = *alignment.registration;
  OdometryEstimate estimate;
  estimate.information = result.information;
  estimate.intensity_inliers = result.intensity_inliers;
  estimate.degenerate_directions = result.degenerate_directions;
  if (alignment.is_valid) {
    estimate.status = lost_                              ? Status::kRecovered
                      : result.degenerate_directions > 0 ? Status::kDegenerate
                                                         : Status::kTracking;
    if (result.intensity_sigma > 0.0) {
      const double share = usual_intensity_sigma_ > 0.0 ? kSigmaUpdate : 1.0;
      usual_intensity_sigma_ += share * (result.intensity_sigma - usual_intensity_sigma_);
    }
    const Eigen::Vector3d turn_rate_before = motion_.velocity().tail<3>();
    const double seconds = to_seconds(features.stamp - motion_.stamp());
    motion_.measure(features.stamp, result.T_world_sensor, result.degenerate_directions == 0);
    turn_change_ = (motion_.velocity().tail<3>() - turn_rate_before).norm() * seconds;
    update_maps(features);
    still_camera_.follow(features.intensity, motion_.pose());
  } else {
    estimate.status = Status::kLost;
    motion_.coast(features.stamp);
  }
  lost_ = estimate.status == Status::kLost;
  return estimate;
}

void Odometry::restart() {
  maps_.reset();
  first_scan_.reset();
  keyframes_.clear();
  still_camera_.forget();
  origin_ = trimmed_at_ = motion_.pose();
  motion_.rest(motion_.stamp(), origin_);
  lost_ = false;
}

bool Odometry::can_begin_with(const FeatureCloud& features) const {
  const auto count = features.planes.size() + features.edges.size();
  return count >= static_cast<std::size_t>(config_.min_inliers);
}

OdometryEstimate Odometry::initialize(const FeatureCloud& features) {
  OdometryEstimate estimate;
  motion_.place(features.stamp, origin_);
  if (!can_begin_with(features)) {
    estimate.status = Status::kLost;
    return estimate;
  }
  make_maps(features);
  update_maps(features);
  still_camera_.follow(features.intensity, motion_.pose());
  if (is_skewed(features)) first_scan_ = features;
  return estimate;
}

/// A LiDAR that leaves a small room measures points farther apart than its voxels.
void Odometry::coarsen_maps(const FeatureCloud& features) {
  const bool is_scan = !features.planes.empty() && features.planes.front().index >= 0;
  if (config_.voxel_size > 0.0 || !is_scan) return;
  const double voxel = automatic_voxel_size(median_range(features));
  const bool is_far = voxel >= kVoxelGrowth * static_cast<double>(maps_->voxel_size());
  far_scans_ = is_far ? far_scans_ + 1 : 0;
  if (far_scans_ < kMinFarScans) return;
  far_scans_ = 0;
  *maps_ = maps_->resized(voxel, static_cast<std::size_t>(config_.max_voxels));
  if (config_.map_radius == 0.0) map_radius_ = kMapRadius * voxel;
}

/// Without content; the features decide on the voxels.
void Odometry::make_maps(const FeatureCloud& features) {
  const double voxel =
      config_.voxel_size > 0.0 ? config_.voxel_size : automatic_voxel_size(median_range(features));
  map_radius_ = config_.map_radius > 0.0 ? config_.map_radius : kMapRadius * voxel;
  maps_.emplace(voxel, static_cast<std::size_t>(config_.max_voxels));
}

/// Two scans give the velocity, which skewed both alike: the first is mapped again, the second
/// localized again. The first frame's stamp stays the origin.
/// @param first, second  as measured, not de-skewed
OdometryEstimate Odometry::begin_in_motion(FeatureCloud first, FeatureCloud second) {
  const Vector6d velocity = motion_.velocity();
  deskew(first, velocity);
  deskew(second, velocity);
  motion_.move(first.stamp, origin_ * se3::exp(velocity * to_seconds(first.points_offset)));
  maps_.emplace(static_cast<double>(maps_->voxel_size()),
                static_cast<std::size_t>(config_.max_voxels));
  update_maps(first);
  return track(align_at_pose_time(std::move(second)));
}

OdometryEstimate Odometry::relocate(Timestamp stamp, const Transform<World, Sensor>& T_world_sensor,
                                    const std::vector<PlacedFeatures>& surroundings) {
  // The features of a scan are at the center of its time.
  const double since = to_seconds(last_features_.stamp - stamp);
  motion_.rest(last_features_.stamp,
               T_world_sensor.isometry() * se3::exp(motion_.velocity() * since));
  still_camera_.forget();
  const bool is_new = !maps_;
  if (is_new) make_maps(last_features_);
  for (const PlacedFeatures& placed : surroundings) {
    maps_->insert(placed.features, placed.T_world_sensor,
                  config_.registration.geometric.association);
  }
  update_maps(last_features_);
  lost_ = false;
  OdometryEstimate estimate;
  estimate.stamp = stamp;
  estimate.T_world_sensor = T_world_sensor;
  estimate.status = Status::kRecovered;
  return estimate;
}

std::optional<Transform<World, Sensor>> Odometry::expected(const FeatureCloud& features) const {
  const auto predicted = expected(features.stamp);
  if (!predicted) return predicted;
  if (features.intensity.empty()) {
    // A scan of a vehicle may be meters from the first one.
    const bool is_known =
        motion_.knows_velocity() ||
        motion_.predict(features.stamp).translation_sigma < PosePrediction::kUnknown;
    return is_known ? predicted : std::nullopt;
  }
  const double uncertain = turn_change_ * static_cast<double>(median_range(features));
  if (uncertain < kMaxExpectedSigma) return predicted;
  const Alignment alignment = align_at_pose_time(at_pose_time(features));
  const bool all_fit =
      alignment.is_valid && alignment.registration->geometric.inliers() >=
                                kAllFit * offered(features, config_.registration.geometric);
  if (!all_fit) return predicted;
  return Transform<World, Sensor>(alignment.registration->T_world_sensor);
}

std::optional<Transform<World, Sensor>> Odometry::expected(Timestamp stamp) const {
  if (!maps_) return std::nullopt;
  const PosePrediction prediction = motion_.predict(stamp);
  const bool turns = turn_rate() >= kMaxExpectedTurnRate;
  if (turns && !prediction.is_sensed) return std::nullopt;
  const bool is_lost = lost_ && !(prediction.translation_sigma < kMaxExpectedSigma);
  if (is_lost) return std::nullopt;
  return Transform<World, Sensor>(prediction.T_world_sensor);
}

void Odometry::update_maps(const FeatureCloud& features) {
  const Isometry& pose = motion_.pose();
  coarsen_maps(features);
  maps_->insert(features, pose, config_.registration.geometric.association);
  keyframes_.update(features.intensity, pose);
  if ((pose.translation() - trimmed_at_.translation()).norm() > kTrimInterval * map_radius_) {
    maps_->remove_farther_than(pose.translation().cast<float>(), static_cast<float>(map_radius_));
    trimmed_at_ = pose;
  }
}

}  // namespace mms
