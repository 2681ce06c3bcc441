#include "mms/pipeline/localization.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/pipeline/stage_timer.hpp"

namespace mms {
namespace {

/// [-]: lost frames in a row after which the place is searched for in the global map. Source: the
/// odometry recovers from fewer by itself.
constexpr int kMinLostFrames = 3;

/// [s]: time without frames after which the motion since is not known, so that a similar place
/// could be taken for the right one. Source: at 1 m/s the right pose is a meter away.
constexpr Duration kMaxGap = std::chrono::seconds(1);

/// [-]: the same as a multiple of the time between the frames before. Source: initial choice; some
/// recordings have less than a frame a second.
constexpr int kMaxGapOfInterval = 5;

/// [m]: distance of a recognized place from the pose of the odometry up to which they agree.
/// Source: errors of poses from keypoints, far below the distance of similar places.
constexpr double kMaxDistance = 0.2;

/// [rad]: the same of the angle. Source: as `kMaxDistance`.
constexpr double kMaxTurn = 0.1;

/// [s]: first part of a run in which the place in an earlier map is searched for at short
/// intervals. Source: initial choice; people may cover the view for some seconds.
constexpr Duration kSearchTime = std::chrono::seconds(5);

/// [s]: these intervals. Source: two views must agree, and within 1 s of the start some may fail.
constexpr Duration kSearchInterval = std::chrono::milliseconds(200);

/// [-]: part of the time since the start that an interval is, at least. Source: `kSearchTime` over
/// `kSearchInterval`; an hour in an unknown place has about 190 such views.
constexpr int kSearchShare = 25;

/// [s]: time for which a sensor with enough features is lost after which a new session begins.
/// Source: nine of ten kidnapped cameras are relocalized within 1 s, if their place is known.
constexpr Duration kSessionDelay = std::chrono::seconds(3);

/// [s]: time for which the place that a user gives is searched for. Source: initial choice; people
/// may cover the view for some seconds, and later the odometry has drifted.
constexpr Duration kExpectationTime = std::chrono::seconds(10);

bool agree(const OdometryEstimate& odometry, const Relocalization& place) {
  const Eigen::Isometry3d difference =
      (odometry.T_world_sensor.inverse() * place.T_world_sensor).isometry();
  return difference.translation().norm() < kMaxDistance && se3::angle(difference) < kMaxTurn;
}

/// Start and end of a scan; twice the stamp of an image.
std::pair<Timestamp, Timestamp> times_of(const LabeledCloud& cloud, const FeatureCloud& features) {
  if (cloud.organised()) return {cloud.stamp, cloud.stamp};
  const Timestamp center = cloud.stamp + features.points_offset;
  return {center - features.half_duration, center + features.half_duration};
}

/// The modes without the method's geometry are baselines: they get none of the steps beyond it.
template <class Config>
Config for_mode(Config step, FusionMode mode) {
  if (mode != FusionMode::kMultimodal) step.enabled = false;
  return step;
}

}  // namespace

Localization::Session::Session(const SystemConfig& config)
    : motion_segmentation(for_mode(config.motion_segmentation, config.fusion.mode), config.noise),
      hypotheses(for_mode(config.mask_check, config.fusion.mode),
                 with_noise(config.features, config.noise), config.fusion.sizes),
      keyframes(config.keyframes),
      global_keyframes(config.global_map.keyframes),
      scan_keyframes(config.global_map.scan_keyframes) {}

Localization::Localization(const SystemConfig& config)
    : config_(config),
      odometry_(config.odometry, config.noise.depth),
      robot_body_(for_mode(config.robot_body, config.fusion.mode), config.noise.depth),
      session_(config),
      closes_loops_(config.global_map.enabled) {}

FrameResult Localization::localize(PerceivedFrame frame) {
  assert(thread_.is_owner());
  const bool is_first = last_stamp_ == Timestamp();
  const Duration interval = is_first ? Duration::zero() : frame.cloud.stamp - last_stamp_;
  const Duration last_interval = std::exchange(last_interval_, interval);
  last_stamp_ = frame.cloud.stamp;
  const bool is_gap = last_interval > Duration::zero() &&
                      interval > std::max(kMaxGap, kMaxGapOfInterval * last_interval);
  if (is_lost_for_long(interval, frame.features)) begin_session();
  const auto given = closes_loops_ ? frame.expected_place : std::nullopt;
  if (given) search_again(frame.cloud.stamp);
  FrameResult result;
  result.session = session_number_;
  result.stage_ms = frame.stage_ms;
  result.cloud = std::move(frame.cloud);
  result.odometry = timed(result.stage_ms, Stage::kOdometry, [&] {
    const auto [from, to] = times_of(result.cloud, frame.features);
    odometry_.sense(frame.motion, frame.motion_calibration, result.cloud.organised());
    robot_body_.sense(frame.motion, frame.motion_calibration);
    const Vector6d expected = odometry_.velocity(from, to);
    deskew(result.cloud, expected);
    robot_body_.exclude(result.cloud, frame.features);
    const std::optional<RobotBody::SeenFrame> seen = robot_body_.see(result.cloud, frame.features);
    exclude_moving_points(result.cloud, frame.features);
    OdometryEstimate estimate = estimate_pose(frame, result.cloud, std::move(frame.features));
    is_in_doubt_ |= is_gap && has_global_keyframe_ && !odometry_.looks_right();
    search_robot_body(seen, result, estimate);
    const std::optional<Vector6d>& velocity = odometry_.unexpected_velocity();
    if (velocity) deskew(result.cloud, Vector6d(*velocity - expected));
    result.begins_anew = odometry_.begins_anew();
    if (result.begins_anew) session_ = Session(config_);
    return estimate;
  });
  result.correction = corrections_.at(result.odometry.stamp);
  if (given) {
    expected_ = {result.odometry.stamp, *given * result.odometry.T_world_sensor.inverse()};
  }
  result.expected_place = expected_place(result);
  for (std::string& warning : odometry_.take_warnings()) {
    result.warnings.push_back(std::move(warning));
  }
  result.wants_relocalization = wants_relocalization(result);
  if (result.wants_relocalization) {
    result.has_pose_in_doubt = result.odometry.status != Status::kLost;
    result.odometry.status = Status::kLost;
  } else {
    choose_keyframes(result);
  }
  is_lost_ = result.odometry.status == Status::kLost;
  result.dynamic_share = dynamic_share(result.cloud);
  result.overruled_share = overruled_share(result.cloud, result.cloud.overruled);
  return result;
}

/// III-C.2, III-C.3, eqs. (3)-(5).
OdometryEstimate Localization::estimate_pose(const PerceivedFrame& frame, LabeledCloud& cloud,
                                             FeatureCloud features) {
  const bool begins = odometry_.begins();
  if (begins) masked_start_.reset();
  std::optional<Odometry> before;
  if (begins && cloud.organised()) before = odometry_;
  FeatureCloud beside_masks;
  if (before || masked_start_) beside_masks = features;
  OdometryEstimate estimate =
      odometry_.accept(session_.hypotheses.align(odometry_, cloud, std::move(features)));
  if (before && overruled_share(cloud, cloud.overruled) > 0.0 &&
      before->can_begin_with(beside_masks)) {
    masked_start_.emplace(*before);
  }
  if (!masked_start_) return estimate;
  if (!before) masked_start_->following().sense(frame.motion, frame.motion_calibration, true);
  const MaskedStart::Verdict verdict = masked_start_->add(std::move(beside_masks), estimate);
  if (verdict == MaskedStart::Verdict::kOpen) return estimate;
  if (verdict == MaskedStart::Verdict::kMasksAreRight) {
    odometry_ = masked_start_->following();
    estimate = masked_start_->estimate();
    robot_body_.restart();
    session_ = Session(config_);
    cloud.overruled = {};
  }
  masked_start_.reset();
  return estimate;
}

/// An odometry that a part of the robot held begins anew, with all that compares frames with those
/// before.
void Localization::search_robot_body(const std::optional<RobotBody::SeenFrame>& seen,
                                     FrameResult& result, OdometryEstimate& estimate) {
  RobotBody::Found found = robot_body_.search(seen, odometry_, estimate);
  if (!found.is_new) return;
  const auto percent = std::lround(100.0 * robot_body_.share());
  result.warnings.push_back(std::to_string(percent) +
                            " % of the image show the robot itself: they are ignored");
  if (!found.correction) return;
  odometry_ = std::move(found.correction->odometry);
  estimate = found.correction->estimate;
  session_ = Session(config_);
  masked_start_.reset();
}

FrameResult Localization::relocate(FrameResult lost, const Relocalization& place) {
  assert(thread_.is_owner());
  if (place.begins_session) {
    begin_session();
    searches_place_ = !place.T_global_world;
    lost.session = session_number_;
    lost.correction.T_global_world = place.T_global_world;
    corrections_.reset(place.T_global_world);
  }
  if (!place.begins_session && lost_frames_ == 0 && agree(lost.odometry, place)) {
    lost.odometry.status = Status::kRecovered;
  } else {
    lost.odometry =
        odometry_.relocate(lost.odometry.stamp, place.T_world_sensor, place.surroundings);
    robot_body_.restart();
    lost.relocalized = true;
    // The odometry measured no motion to there, though it may have had a pose.
    lost_since_global_keyframe_ = true;
  }
  lost_frames_ = 0;
  is_in_doubt_ = is_lost_ = false;
  masked_start_.reset();
  choose_keyframes(lost);
  return lost;
}

/// Counts the time of frames with enough features. Without loop closure, nothing would tell where
/// a new session is.
bool Localization::is_lost_for_long(Duration interval, const FeatureCloud& features) {
  if (!closes_loops_ || !has_global_keyframe_ || !is_lost_) {
    lost_for_ = Duration::zero();
    return false;
  }
  if (!odometry_.can_begin_with(features)) return false;
  lost_for_ += interval;
  return lost_for_ >= kSessionDelay;
}

/// The world goes on from the predicted pose, so that it does not jump; its place in the map is
/// unknown until loops join it.
void Localization::begin_session() {
  ++session_number_;
  odometry_.restart();
  robot_body_.restart();
  session_ = Session(config_);
  corrections_.reset(std::nullopt);
  searches_place_ = true;
  search_begin_.reset();
  lost_for_ = Duration::zero();
  lost_frames_ = 0;
  is_in_doubt_ = has_global_keyframe_ = false;
}

/// The place is searched for as at the start. Where it seemed known, the user says otherwise.
void Localization::search_again(Timestamp stamp) {
  if (has_global_keyframe_ && corrections_.at(stamp).T_global_world) begin_session();
  searches_place_ = true;
  search_begin_.reset();
}

std::optional<Transform<Global, Sensor>> Localization::expected_place(const FrameResult& result) {
  if (!expected_) return std::nullopt;
  const bool is_known = result.correction.T_global_world.has_value();
  if (is_known || result.odometry.stamp - expected_->stamp > kExpectationTime) {
    expected_.reset();
    return std::nullopt;
  }
  return expected_->T_global_world * result.odometry.T_world_sensor;
}

/// Similar places can mislead the odometry after a loss: until the place is recognized, or the
/// views there confirm its pose, the sensor counts as lost.
bool Localization::wants_relocalization(const FrameResult& result) {
  if (!closes_loops_) return false;
  if (result.odometry.status == Status::kLost) lost_since_global_keyframe_ = true;
  lost_frames_ = result.odometry.status == Status::kLost ? lost_frames_ + 1 : 0;
  // A scan of which the odometry has a pose is not in doubt.
  if (!result.cloud.organised()) return has_global_keyframe_ && lost_frames_ >= kMinLostFrames;
  is_in_doubt_ |= has_global_keyframe_ && lost_frames_ >= kMinLostFrames;
  return is_in_doubt_;
}

/// Chooses the keyframes of III-C.4, and those of the global map.
void Localization::choose_keyframes(FrameResult& result) {
  const OdometryEstimate& odometry = result.odometry;
  result.keyframe = session_.keyframes.is_keyframe(odometry);
  if (result.keyframe) {
    session_.motion_segmentation.remember(result.cloud, odometry.T_world_sensor);
    session_.hypotheses.remember(result.cloud, odometry.T_world_sensor);
  }
  if (!closes_loops_) return;
  KeyframeSelector& global =
      result.cloud.organised() ? session_.global_keyframes : session_.scan_keyframes;
  result.global_keyframe = global.is_keyframe(result.odometry) || is_search_keyframe(result);
  has_global_keyframe_ |= result.global_keyframe;
  if (result.global_keyframe) {
    result.after_lost = std::exchange(lost_since_global_keyframe_, false);
  }
}

/// A sensor that stands still where the map begins has no keyframes by distance.
bool Localization::is_search_keyframe(const FrameResult& result) {
  const OdometryEstimate& odometry = result.odometry;
  if (!searches_place_ || odometry.status == Status::kLost) return false;
  if (!search_begin_) search_begin_ = last_search_ = odometry.stamp;
  const Duration since = odometry.stamp - *search_begin_;
  if (since > kSearchTime && result.correction.T_global_world) searches_place_ = false;
  // Ever more rarely, so that a sensor that stands in an unknown place hardly takes memory.
  if (odometry.stamp - last_search_ < std::max(kSearchInterval, since / kSearchShare)) return false;
  last_search_ = odometry.stamp;
  return true;
}

void Localization::exclude_moving_points(LabeledCloud& cloud, FeatureCloud& features) const {
  const auto expected = odometry_.expected(features);
  if (!expected) return;
  const Image<std::uint8_t> moved = session_.motion_segmentation.relabel(cloud, *expected);
  if (!moved.empty()) exclude(moved, cloud, features);
}

}  // namespace mms
