#include "mms/localization/registration_choice.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/photometric/image_shift.hpp"

namespace mms {
namespace {

/// [-]: factor by which dropping the prediction must increase the inliers to be accepted.
/// Source: 5 % exceeds the chance variation sqrt(n) of n > 400 inliers.
constexpr double kMinInlierGain = 1.05;

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

/// [-]: factor of the usual spread of the photometric residuals from which on the pose is doubted.
/// Source: in `long_aisles`, seed 4, 99 % of the frames have less. Where the pose was off by 3 cm
/// and more, it was 1.9 to 3.8, also in seed 3.
constexpr double kMisfit = 1.85;

/// [-]: factor by which the spread may grow with a turn that more features fit. Source: wrong turns
/// in `long_aisles`, seed 4, had 4.6 and more; with 2.0, `desk_crowd` at 5 Hz was off by 19 cm in
/// place of 6 cm.
constexpr double kContradiction = 3.0;

/// [-]: factor by which the spread must fall for a turn, where most features fit both.
/// Source: right turns in `long_aisles`, seeds 3 and 4, had 1.3 to 2.5.
constexpr double kMinSharpening = 1.15;

/// [-]: the same where few features fit. Source: with 1.15, `desk_crowd` at 5 and 3 Hz was off by
/// 13 and 40 cm, with 1.5 by 7 and 14 cm.
constexpr double kMinSharpeningOfFew = 1.5;

/// [-]: voxels of the first guess over those of the maps, where the velocity is unknown.
/// Source: 1.6 m at 10 m of range; at 20 m/s and 10 Hz a scan is 2 m from the one before, and a
/// voxel and its neighbors are searched.
constexpr double kFarVoxels = 4.0;

/// Whether wheels or gyroscope say that the motion changed more than vehicles and people change it.
bool is_jump(const PosePrediction& sensed, const PosePrediction& extrapolated) {
  const Eigen::Isometry3d change = extrapolated.T_world_sensor.inverse() * sensed.T_world_sensor;
  return change.translation().norm() > kMaxJump * extrapolated.translation_sigma ||
         se3::angle(change) > kMaxJump * extrapolated.rotation_sigma;
}

/// How much smaller the photometric residuals are: above one, if those of `other` are smaller.
double sharpening(const RegistrationResult& other, const RegistrationResult& best) {
  if (other.intensity_sigma > 0.0) return best.intensity_sigma / other.intensity_sigma;
  return best.intensity_sigma > 0.0 ? 0.0 : 1.0;
}

/// Whether another turn has more inliers, and the pixels do not contradict; or the pixels agree
/// clearly better, with about as many inliers.
/// @param fits  whether most features fit the best result
bool agrees_better(const RegistrationResult& other, const RegistrationResult& best, bool fits) {
  const double gain = other.geometric.inliers() / std::max(1.0, 1.0 * best.geometric.inliers());
  const double sharper = sharpening(other, best);
  const double min_gain =
      other.intensity_inliers < best.intensity_inliers ? kMinTurnGain : kMinInlierGain;
  return (gain > min_gain && sharper > 1.0 / kContradiction) ||
         (gain > 1.0 / kMinInlierGain && sharper > (fits ? kMinSharpening : kMinSharpeningOfFew));
}

}  // namespace

bool RegistrationChoice::is_valid(const RegistrationResult& result) const {
  const int inliers = result.geometric.inliers();
  if (inliers + result.intensity_inliers < config_.min_inliers) return false;
  if (inliers < config_.min_inlier_share * offered(features_, config_.registration.geometric)) {
    return false;
  }
  if (!result.T_world_sensor.matrix().allFinite()) return false;
  return motion_.is_feasible(features_.stamp, result.T_world_sensor);
}

RegistrationResult RegistrationChoice::best() const {
  const PosePrediction prediction = motion_.predict(features_.stamp);
  if (prediction.is_sensed) return register_far(register_sensed(prediction), prediction);
  return register_stopped(register_turned(register_far(register_predicted(prediction), prediction)),
                          prediction);
}

/// A scan of a sensor of unknown velocity may be farther from the last one than the voxels reach:
/// if few features fit, registration begins with larger ones.
/// @param best  from the predicted pose
RegistrationResult RegistrationChoice::register_far(RegistrationResult best,
                                                    const PosePrediction& prediction) const {
  if (!features_.intensity.empty()) return best;
  if (prediction.translation_sigma < PosePrediction::kUnknown) return best;
  const bool fits =
      best.degenerate_directions == 0 && is_valid(best) &&
      best.geometric.inliers() >= kGoodFit * offered(features_, config_.registration.geometric);
  if (fits) return best;
  const LocalMaps far = maps_.resized(kFarVoxels * static_cast<double>(maps_.voxel_size()),
                                      static_cast<std::size_t>(config_.max_voxels));
  const RegistrationResult guess = register_frame(features_, {far, {}}, {prediction.T_world_sensor},
                                                  config_.registration, noise_);
  RegistrationResult other = register_near({guess.T_world_sensor}, config_.registration);
  const bool is_better = other.geometric.inliers() > kMinInlierGain * best.geometric.inliers() &&
                         other.degenerate_directions <= best.degenerate_directions;
  return is_better && is_valid(other) ? other : best;
}

/// After a gap, or a loss, a sensor that has stopped is where it was. Images find that by their
/// turns.
/// @param best  from the predicted pose
RegistrationResult RegistrationChoice::register_stopped(RegistrationResult best,
                                                        const PosePrediction& prediction) const {
  if (!features_.intensity.empty()) return best;
  const Eigen::Isometry3d& last = motion_.measured();
  const double way = (prediction.T_world_sensor.translation() - last.translation()).norm();
  const auto voxel = static_cast<double>(maps_.voxel_size());
  const bool is_near =
      way < config_.registration.geometric.gate * voxel || prediction.translation_sigma < voxel;
  if (is_near) return best;
  RegistrationResult stopped = register_near({last}, config_.registration);
  const bool is_better =
      !is_valid(best) || stopped.geometric.inliers() > kMinInlierGain * best.geometric.inliers();
  return is_better && stopped.degenerate_directions == 0 && is_valid(stopped) ? stopped : best;
}

/// Whether the pixels agree as well as usual.
bool RegistrationChoice::looks_right(const RegistrationResult& result) const {
  return usual_intensity_sigma_ == 0.0 ||
         result.intensity_sigma <= kMisfit * usual_intensity_sigma_;
}

/// Poses with the turns that the last two images give, the most likely first.
/// @param at_predicted_place  whether those at the predicted place come first, else those at the
/// last one
std::vector<Eigen::Isometry3d> RegistrationChoice::turn_guesses(bool at_predicted_place) const {
  const Eigen::Isometry3d last = motion_.pose();
  const Eigen::Isometry3d predicted = motion_.predict(features_.stamp).T_world_sensor;
  const auto turns = rotations_by_shift(last_features_.intensity.back(), features_.intensity.back(),
                                        kMaxTurnGuesses);
  std::vector<Eigen::Isometry3d> guesses;
  for (const bool is_predicted : {at_predicted_place, !at_predicted_place}) {
    for (const Eigen::Matrix3d& turn : turns) {
      guesses.push_back(is_predicted ? predicted : last);
      guesses.back().linear() = last.linear() * turn;
    }
  }
  return guesses;
}

/// Where a turn that the last velocity does not predict may have misled the registration, it begins
/// again from rotations that the images give: where few features fit, or the pixels do not agree.
/// @param best  as predicted
RegistrationResult RegistrationChoice::register_turned(RegistrationResult best) const {
  const bool has_images = !features_.intensity.empty() && !last_features_.intensity.empty();
  const bool fits =
      best.geometric.inliers() >= kGoodFit * offered(features_, config_.registration.geometric);
  if (!has_images || (fits && looks_right(best))) return best;
  const std::vector<Eigen::Isometry3d> guesses = turn_guesses(fits);
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const bool doubted = !looks_right(best);
    if (i >= guesses.size() / 2 && (fits || !doubted)) break;
    const double change = se3::angle(guesses[i].inverse() * best.T_world_sensor);
    if (!doubted && change < kMinTurnChange) continue;
    RegistrationResult other = register_near({guesses[i]}, config_.registration);
    if (agrees_better(other, best, fits) && is_valid(other)) best = std::move(other);
  }
  return best;
}

/// Where wheels or gyroscope jump (slip), data alone give the pose if they can. Else the sensors
/// predict so well that people get less weight from the start. Where the result contradicts them,
/// either they are wrong (slip), or the data are (people that move with the sensor). The surfaces
/// decide that constrain the pose along the disagreement: if enough of them fit at the predicted
/// pose, it is right.
RegistrationResult RegistrationChoice::register_sensed(const PosePrediction& prediction) const {
  RegistrationConfig near = config_.registration;
  const double error = prediction.translation_sigma +
                       prediction.rotation_sigma * static_cast<double>(median_range(features_));
  near.geometric.initial_scale =
      std::min(near.geometric.initial_scale, error / static_cast<double>(maps_.voxel_size()));
  const PosePrediction extrapolated = motion_.extrapolate(features_.stamp);
  if (is_jump(prediction, extrapolated)) {
    RegistrationResult alone = register_predicted(extrapolated);
    if (is_valid(alone) && alone.degenerate_directions == 0) return alone;
  }
  const RegistrationResult led = register_near(prediction, near);
  const bool agrees = !motion_.contradiction(features_.stamp, led.T_world_sensor);
  if (is_valid(led) && agrees) return led;
  const RegistrationResult free = register_predicted(extrapolated);
  const bool fits_better = free.geometric.inliers() > led.geometric.inliers();
  const bool is_led = is_valid(led) && (!is_valid(free) || !fits_better);
  const RegistrationResult& best = is_led ? led : free;
  const auto contradiction = motion_.contradiction(features_.stamp, best.T_world_sensor);
  if (!contradiction) return best;
  PosePrediction pinned = *contradiction;
  pinned.translation_sigma *= kPinned;
  pinned.rotation_sigma *= kPinned;
  near.geometric.initial_scale = 0.0;
  const RegistrationResult kept = register_near(pinned, near);
  Vector6d along = se3::log(kept.T_world_sensor.inverse() * best.T_world_sensor);
  const double support = along.dot(kept.information * along);
  const double other = along.dot(best.information * along);
  const bool is_right = is_valid(kept) && support > kMinSupport * other;
  return is_right ? kept : best;
}

/// The annealed scale gives people as much weight as the static scene at first: if the result is
/// not valid, registration runs again without it. Data that contradict the prediction lose their
/// weight and look degenerate: if they determine the pose without the prediction, and with more
/// inliers, the sensor was pushed, and that result is taken.
RegistrationResult RegistrationChoice::register_predicted(const PosePrediction& prediction) const {
  RegistrationResult best = register_near(prediction, config_.registration);
  if (!is_valid(best)) {
    RegistrationConfig strict = config_.registration;
    strict.geometric.initial_scale = 0.0;
    const RegistrationResult other = register_near(prediction, strict);
    if (other.geometric.inliers() >= best.geometric.inliers()) best = other;
  }
  if (best.degenerate_directions > 0 && prediction.is_informative()) {
    const RegistrationResult alone =
        register_near({prediction.T_world_sensor}, config_.registration);
    const bool agrees_better =
        alone.geometric.inliers() > kMinInlierGain * best.geometric.inliers();
    if (alone.degenerate_directions == 0 && agrees_better) best = alone;
  }
  return best;
}

RegistrationResult RegistrationChoice::register_near(const PosePrediction& prediction,
                                                     const RegistrationConfig& config) const {
  return register_frame(features_, {maps_, keyframes_.nearest(prediction.T_world_sensor)},
                        prediction, config, noise_);
}

}  // namespace mms
