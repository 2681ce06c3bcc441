#include "mms/localization/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/localization/photometric/image_shift.hpp"

namespace mms {
namespace {

/// [-]: factor by which dropping the prediction must increase the inliers to be accepted.
/// Source: 5 % exceeds the chance variation sqrt(n) of n > 400 inliers.
constexpr double kMinInlierGain = 1.05;

/// [voxels]: automatic radius of the local maps.
/// Source: eight times the median range (`automatic_voxel_size`), farther than most frames see.
constexpr double kMapRadius = 200.0;

/// [-]: share of the map radius that the sensor moves before the maps are trimmed to it.
/// Source: computing time; the maps exceed their radius by a tenth at most.
constexpr double kTrimInterval = 0.1;

/// [rad/s]: a faster turn makes the expected pose too uncertain for motion segmentation.
/// Source: scene `fast`, whose ATE was 13.5 cm and 5 frames lost without this bound.
constexpr double kMaxExpectedTurnRate = 0.5;

/// [-]: share of the information along a disagreement, at a pose that wheels or gyroscope predict,
/// from which on they are right.
/// Source: initial choice; at the wrong pose the surfaces across the disagreement do not fit.
constexpr double kMinSupport = 0.25;

/// [-]: standard deviations of constant velocity by which a measured motion may differ from it.
/// Source: initial choice; 30 % of slip at 1 m/s are nearly three at the rate of a camera, braking
/// at 2 m/s^2 is one.
constexpr double kMaxJump = 2.0;

/// [-]: factor of the standard deviations of a prediction that is tried in place of the data.
/// Source: initial choice; small enough to keep the pose, large enough to let it fit the surfaces.
constexpr double kPinned = 0.1;

/// [m]: standard deviation of the prediction up to which a lost sensor's pose is expected.
/// Source: a third of the 0.15 m by which a moving point lies in free space: three sigma.
constexpr double kMaxExpectedSigma = 0.05;

/// [m]: displacement of points at the ends of a scan, by an error of the velocity, from which on
/// the scan is de-skewed again. Source: above the 2 cm of a LiDAR's noise.
constexpr double kMinDisplacement = 0.03;

/// [-]: times that a scan is de-skewed again. Source: two to four were needed where a robot begins
/// to turn by 70 degrees/s.
constexpr int kMaxDeskewings = 4;

/// [-]: share of inliers from which on no other turn is tried. Source: with 0.7, `desk_crowd` at
/// 7.5 Hz was off by 3.8 cm, with 0.8 by 1.6 cm; on other recordings most frames have more.
constexpr double kGoodFit = 0.8;

/// [-]: turns by the images that are tried. Source: with one, `desk_crowd` at 3 to 5 Hz was off by
/// 26 to 30 cm in three of four parts, with two by 2 to 10 cm; a third one changed nothing.
constexpr std::size_t kMaxTurnGuesses = 2;

/// [rad]: angle to the result below which a turn is not tried, since registration converges from
/// there. Source: with 2.5 degrees, an earlier version was off by 20 cm in `desk_crowd` at 5 Hz.
constexpr double kMinTurnChange = 2.0 * std::numbers::pi / 180.0;

/// [-]: as `kMinInlierGain`, for a turn with which fewer pixels agree. Source: in `desk_crowd`
/// right turns had 1.13 and more; a wrong one, under false masks in `lab_crowd`, had 1.07.
constexpr double kMinTurnGain = 1.1;

bool is_scan(const FeatureCloud& features) {
  return features.intensity.empty() && features.points_offset > Duration::zero();
}

/// Whether wheels or gyroscope say that the motion changed more than vehicles and people change it.
bool is_jump(const PosePrediction& sensed, const PosePrediction& extrapolated) {
  const Eigen::Isometry3d change = extrapolated.T_world_sensor.inverse() * sensed.T_world_sensor;
  return change.translation().norm() > kMaxJump * extrapolated.translation_sigma ||
         se3::angle(change) > kMaxJump * extrapolated.rotation_sigma;
}

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
  v.group({"motion", "", "how the sensor moves between frames"}, motion);
  v.group({"registration", "", "robust Gauss-Newton of a frame against the local maps"},
          registration);
}

Odometry::Odometry(const OdometryConfig& config, const DepthNoise& noise)
    : config_(config),
      keyframes_(config.registration.photometric, noise),
      noise_(noise),
      motion_(config.motion) {}

Odometry::Alignment Odometry::align(FeatureCloud measured) const {
  const Timestamp stamp = measured.stamp;
  Alignment alignment = is_scan(measured) ? align_scan(measured)
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
  const double displacement =
      to_seconds(features.points_offset) *
      (change.head<3>().norm() + change.tail<3>().norm() * median_range(features));
  if (displacement < kMinDisplacement) return std::nullopt;
  return velocity;
}

OdometryEstimate Odometry::accept(Alignment alignment) {
  const std::optional<FeatureCloud> first = std::exchange(first_scan_, std::nullopt);
  OdometryEstimate estimate =
      alignment.registration ? track(alignment) : initialize(alignment.features);
  if (first && !lost_) estimate = begin_in_motion(*first, alignment.features);
  estimate.stamp = alignment.stamp;
  estimate.T_world_sensor =
      Transform<World, Sensor>(motion_.predict(alignment.stamp).T_world_sensor);
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
  alignment.registration = register_best(alignment.features);
  alignment.is_valid = is_valid(alignment.features, *alignment.registration);
  return alignment;
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
                          : motion_.velocity(features.stamp, center + features.points_offset));
  features.stamp = features.stamp + features.points_offset;
  return features;
}

OdometryEstimate Odometry::track(const Alignment& alignment) {
  const FeatureCloud& features = alignment.features;
  const RegistrationResult& result = *alignment.registration;
  OdometryEstimate estimate;
  estimate.information = result.information;
  estimate.edge_inliers = result.geometric.edges.inliers;
  estimate.plane_inliers = result.geometric.planes.inliers;
  estimate.intensity_inliers = result.intensity_inliers;
  estimate.iterations = result.iterations;
  estimate.degenerate_directions = result.degenerate_directions;
  estimate.plane_rms =
      std::sqrt(result.geometric.plane_square_sum / std::max(1, result.geometric.planes.inliers));
  if (alignment.is_valid) {
    estimate.status = lost_                              ? Status::kRecovered
                      : result.degenerate_directions > 0 ? Status::kDegenerate
                                                         : Status::kTracking;
    motion_.measure(features.stamp, result.T_world_sensor, result.degenerate_directions == 0);
    update_maps(features);
  } else {
    estimate.status = Status::kLost;
    motion_.coast(features.stamp);
  }
  lost_ = estimate.status == Status::kLost;
  return estimate;
}

RegistrationResult Odometry::register_best(const FeatureCloud& features) const {
  const PosePrediction prediction = motion_.predict(features.stamp);
  if (prediction.is_sensed) return register_sensed(features, prediction);
  return register_turned(features, register_predicted(features, prediction));
}

/// Where a turn that the last velocity does not predict may have misled the registration, it begins
/// again from rotations that the images give.
/// @param best  as predicted
RegistrationResult Odometry::register_turned(const FeatureCloud& features,
                                             RegistrationResult best) const {
  const auto offered = static_cast<double>(features.edges.size() + features.planes.size());
  const bool has_images = !features.intensity.empty() && !last_features_.intensity.empty();
  if (!has_images || best.geometric.inliers() >= kGoodFit * offered) return best;
  const Isometry last = motion_.pose();
  for (const Eigen::Matrix3d& turn : rotations_by_shift(
           last_features_.intensity.back(), features.intensity.back(), kMaxTurnGuesses)) {
    Isometry guess = last;
    guess.linear() = last.linear() * turn;
    if (se3::angle(guess.inverse() * best.T_world_sensor) < kMinTurnChange) continue;
    RegistrationResult other = register_near(features, {guess}, config_.registration);
    const double gain =
        other.intensity_inliers < best.intensity_inliers ? kMinTurnGain : kMinInlierGain;
    const bool agrees_better = other.geometric.inliers() > gain * best.geometric.inliers();
    if (agrees_better && is_valid(features, other)) best = std::move(other);
  }
  return best;
}

/// Where wheels or gyroscope jump (slip), data alone give the pose if they can. Else the sensors
/// predict so well that people get less weight from the start. Where the result contradicts them,
/// either they are wrong (slip), or the data are (people that move with the sensor). The surfaces
/// decide that constrain the pose along the disagreement: if enough of them fit at the predicted
/// pose, it is right.
RegistrationResult Odometry::register_sensed(const FeatureCloud& features,
                                             const PosePrediction& prediction) const {
  RegistrationConfig near = config_.registration;
  const double error = prediction.translation_sigma +
                       prediction.rotation_sigma * static_cast<double>(median_range(features));
  near.geometric.initial_scale =
      std::min(near.geometric.initial_scale, error / static_cast<double>(maps_->voxel_size()));
  const PosePrediction extrapolated = motion_.extrapolate(features.stamp);
  if (is_jump(prediction, extrapolated)) {
    RegistrationResult alone = register_predicted(features, extrapolated);
    if (is_valid(features, alone) && alone.degenerate_directions == 0) return alone;
  }
  const RegistrationResult led = register_near(features, prediction, near);
  const bool agrees = !motion_.contradiction(features.stamp, led.T_world_sensor);
  if (is_valid(features, led) && agrees) return led;
  const RegistrationResult free = register_predicted(features, extrapolated);
  const bool fits_better = free.geometric.inliers() > led.geometric.inliers();
  const bool is_led = is_valid(features, led) && (!is_valid(features, free) || !fits_better);
  const RegistrationResult& best = is_led ? led : free;
  const auto contradiction = motion_.contradiction(features.stamp, best.T_world_sensor);
  if (!contradiction) return best;
  PosePrediction pinned = *contradiction;
  pinned.translation_sigma *= kPinned;
  pinned.rotation_sigma *= kPinned;
  near.geometric.initial_scale = 0.0;
  const RegistrationResult kept = register_near(features, pinned, near);
  Vector6d along = se3::log(kept.T_world_sensor.inverse() * best.T_world_sensor);
  const double support = along.dot(kept.information * along);
  const double other = along.dot(best.information * along);
  const bool is_right = is_valid(features, kept) && support > kMinSupport * other;
  return is_right ? kept : best;
}

/// The annealed scale gives people as much weight as the static scene at first: if the result is
/// not valid, registration runs again without it. Data that contradict the prediction lose their
/// weight and look degenerate: if they determine the pose without the prediction, and with more
/// inliers, the sensor was pushed, and that result is taken.
RegistrationResult Odometry::register_predicted(const FeatureCloud& features,
                                                const PosePrediction& prediction) const {
  RegistrationResult best = register_near(features, prediction, config_.registration);
  if (!is_valid(features, best)) {
    RegistrationConfig strict = config_.registration;
    strict.geometric.initial_scale = 0.0;
    const RegistrationResult other = register_near(features, prediction, strict);
    if (other.geometric.inliers() >= best.geometric.inliers()) best = other;
  }
  if (best.degenerate_directions > 0 && prediction.is_informative()) {
    const RegistrationResult alone =
        register_near(features, {prediction.T_world_sensor}, config_.registration);
    const bool agrees_better =
        alone.geometric.inliers() > kMinInlierGain * best.geometric.inliers();
    if (alone.degenerate_directions == 0 && agrees_better) best = alone;
  }
  return best;
}

RegistrationResult Odometry::register_near(const FeatureCloud& features,
                                           const PosePrediction& prediction,
                                           const RegistrationConfig& config) const {
  return register_frame(features, {*maps_, keyframes_.nearest(prediction.T_world_sensor)},
                        prediction, config, noise_);
}

void Odometry::restart() {
  maps_.reset();
  first_scan_.reset();
  keyframes_.clear();
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
  if (features.intensity.empty() && features.points_offset != Duration::zero()) {
    first_scan_ = features;
  }
  return estimate;
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
  motion_.place(first.stamp, origin_ * se3::exp(velocity * to_seconds(first.points_offset)));
  maps_.emplace(static_cast<double>(maps_->voxel_size()),
                static_cast<std::size_t>(config_.max_voxels));
  update_maps(first);
  return track(align_at_pose_time(std::move(second)));
}

OdometryEstimate Odometry::relocate(Timestamp stamp, const Transform<World, Sensor>& T_world_sensor,
                                    const std::vector<PlacedFeatures>& surroundings) {
  motion_.rest(stamp, T_world_sensor.isometry());
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

std::optional<Transform<World, Sensor>> Odometry::expected(Timestamp stamp) const {
  if (!maps_) return std::nullopt;
  const PosePrediction prediction = motion_.predict(stamp);
  const bool turns = turn_rate() >= kMaxExpectedTurnRate;
  if (turns && !prediction.is_sensed) return std::nullopt;
  const bool is_lost = lost_ && !(prediction.translation_sigma < kMaxExpectedSigma);
  if (is_lost) return std::nullopt;
  return Transform<World, Sensor>(prediction.T_world_sensor);
}

bool Odometry::is_valid(const FeatureCloud& features, const RegistrationResult& result) const {
  const int inliers = result.geometric.inliers();
  const auto offered = static_cast<double>(features.edges.size() + features.planes.size());
  if (inliers + result.intensity_inliers < config_.min_inliers) return false;
  if (inliers < config_.min_inlier_share * offered) return false;
  if (!result.T_world_sensor.matrix().allFinite()) return false;
  return motion_.is_feasible(features.stamp, result.T_world_sensor);
}

void Odometry::update_maps(const FeatureCloud& features) {
  const Isometry& pose = motion_.pose();
  maps_->insert(features, pose, config_.registration.geometric.association);
  keyframes_.update(features.intensity, pose);
  if ((pose.translation() - trimmed_at_.translation()).norm() > kTrimInterval * map_radius_) {
    maps_->remove_farther_than(pose.translation().cast<float>(), static_cast<float>(map_radius_));
    trimmed_at_ = pose;
  }
}

}  // namespace mms
