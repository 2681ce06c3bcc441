#include "mms/global_map/global_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/graph/odometry_noise.hpp"
#include "mms/global_map/keyframes/keypoint_extraction.hpp"

namespace mms {
namespace {

/// [-]: candidates of a keyframe by place recognition. Source: computing time.
constexpr std::size_t kMaxRecognized = 3;

/// [-]: candidates of a keyframe by position. Source: computing time.
constexpr std::size_t kMaxNearby = 2;

/// [-]: candidates of a lost frame. Source: computing time; a lost sensor has no better use of it.
constexpr std::size_t kMaxRelocalized = 5;

/// [-]: inliers of a lost frame, as a multiple of those of a loop. Source: no odometry confirms the
/// place; in a warehouse, similar places had 1.5 and the right ones more than three.
constexpr int kInlierFactor = 2;

/// [m]: distance of the places of two lost frames that the errors of their poses explain.
/// Source: initial choice.
constexpr double kMaxStep = 0.1;

/// [rad]: the same of the angle. Source: initial choice, 5 degrees.
constexpr double kMaxStepTurn = 5.0 * std::numbers::pi / 180.0;

/// [m/s]: largest speed between two lost frames. Source: initial choice, a person who walks fast.
constexpr double kMaxSpeed = 2.0;

/// [rad/s]: largest turn rate between two lost frames. Source: initial choice, half a turn a
/// second.
constexpr double kMaxTurnRate = std::numbers::pi;

/// [m]: distance of candidates by position. Source: initial choice; views beyond share too little.
constexpr double kNearby = 1.0;

/// [rad]: angle between the views of candidates by position. Source: as `kNearby`.
constexpr double kNearbyTurn = std::numbers::pi / 6.0;

/// [m]: largest standard deviation of a position by the odometry for candidates by position.
/// Source: registration converges from three of them; structures that repeat are farther apart.
constexpr double kMaxNearbySigma = 0.15;

/// [-]: keyframes between two loops that confirm each other, at most. Source: one of them
/// may be covered by people.
constexpr std::size_t kConfirmation = 2;

/// [m]: largest distance of the positions that two loops give. Source: 95 % of the errors of loops
/// are below 1 cm; along a corridor they are larger.
constexpr double kMaxDifference = 0.05;

/// [rad]: the same of the angle. Source: 95 % of the errors are below 0.1 degrees.
constexpr double kMaxTurn = std::numbers::pi / 180.0;

/// Whether a sensor can move from one pose to the other.
bool agree(const StampedPose& before, const StampedPose& now) {
  const double seconds = std::abs(to_seconds(now.stamp - before.stamp));
  const Eigen::Isometry3d motion =
      (before.T_world_sensor.inverse() * now.T_world_sensor).isometry();
  return motion.translation().norm() < kMaxStep + kMaxSpeed * seconds &&
         se3::angle(motion) < kMaxStepTurn + kMaxTurnRate * seconds;
}

}  // namespace

GlobalMap::GlobalMap(const GlobalMapConfig& config, const FeatureConfig& features,
                     const RegistrationConfig& registration)
    : config_(config),
      extractor_(features),
      noise_(features.noise.depth),
      verifier_(config.loops, registration, noise_) {}

KeyframeRecord GlobalMap::record_of(const GlobalKeyframe& keyframe) const {
  KeyframeRecord record;
  record.stamp = keyframe.cloud.stamp;
  record.T_world_sensor = keyframe.T_world_sensor;
  record.after_lost = keyframe.after_lost;
  record.keypoints = extract_keypoints(keyframe.color, keyframe.cloud, noise_);
  record.features = extractor_.extract(keyframe.cloud);
  record.features.intensity = {};
  record.view = make_keyframe_view(keyframe.cloud);
  return record;
}

std::vector<Loop> GlobalMap::add(const GlobalKeyframe& keyframe) {
  KeyframeRecord record = record_of(keyframe);
  add_node(record);
  const std::vector<Loop> accepted = find_loop(record);
  recognizer_.add(record.keypoints.descriptors);
  records_.push_back(std::move(record));
  recognized_.reset();
  if (!accepted.empty()) solve();
  return accepted;
}

void GlobalMap::add_node(const KeyframeRecord& record) {
  if (records_.empty()) {
    graph_ = PoseGraph(record.T_world_sensor.isometry());
    path_.push_back(0.0);
    return;
  }
  const Eigen::Isometry3d motion =
      records_.back().T_world_sensor.isometry().inverse() * record.T_world_sensor.isometry();
  graph_.add_node(motion, odometry_information(motion, record.after_lost));
  // What was seen before the sensor was lost is not recent.
  const double length = motion.translation().norm() + (record.after_lost ? config_.min_path : 0.0);
  path_.push_back(path_.back() + length);
}

/// The first keyframe that the path since is too short for a loop to; the new one at the latest.
std::size_t GlobalMap::first_recent() const {
  const auto recent = std::upper_bound(path_.begin(), path_.end(), path_.back() - config_.min_path);
  return std::min(static_cast<std::size_t>(recent - path_.begin()), records_.size());
}

/// Earlier keyframes that look in nearly the same direction from nearly the same position.
std::vector<std::size_t> GlobalMap::nearby(std::size_t end) const {
  std::vector<std::pair<double, std::size_t>> near;
  const Eigen::Isometry3d T_sensor_global = graph_.poses().back().inverse();
  for (std::size_t i = 0; i < end; ++i) {
    const Eigen::Isometry3d relative = T_sensor_global * graph_.poses()[i];
    const double distance = relative.translation().norm();
    if (distance > kNearby) continue;
    const double turn = se3::angle(relative);
    if (turn < kNearbyTurn) near.emplace_back(distance + turn, i);
  }
  std::sort(near.begin(), near.end());
  std::vector<std::size_t> keyframes;
  for (const auto& [unused, keyframe] : near) {
    if (keyframes.size() == kMaxNearby) break;
    const Matrix6d covariance = graph_.chain_covariance(keyframe, records_.size());
    const double variance = covariance.topLeftCorner<3, 3>().diagonal().maxCoeff();
    if (variance < kMaxNearbySigma * kMaxNearbySigma) keyframes.push_back(keyframe);
  }
  return keyframes;
}

/// Checks the candidates of the next keyframe until one is accepted: first those at its position,
/// then those that place recognition finds.
std::vector<Loop> GlobalMap::find_loop(const KeyframeRecord& record) {
  const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
  const std::size_t end = first_recent();
  const auto passes = [&](Loop loop) {
    const bool verified = loop.outcome == LoopOutcome::kAccepted;
    if (verified && !is_likely(loop)) loop.outcome = LoopOutcome::kUnlikely;
    loops_.push_back(std::move(loop));
    return loops_.back().outcome == LoopOutcome::kAccepted;
  };
  for (const std::size_t candidate : nearby(end)) {
    const Eigen::Isometry3d expected = poses[candidate].inverse() * poses.back();
    if (passes(verifier_.verify_nearby(records_, poses, candidate, record, expected))) {
      return confirm();
    }
  }
  const std::vector<PlaceCandidate> recognized =
      recognizer_.find(record.keypoints.descriptors, end, kMaxRecognized);
  for (const PlaceCandidate& candidate : recognized) {
    if (passes(verifier_.verify(records_, poses, candidate.keyframe, record))) {
      return confirm();
    }
  }
  return {};
}

/// Whether the odometry since the candidate allows the relative pose.
bool GlobalMap::is_likely(const Loop& loop) const {
  const Eigen::Isometry3d expected =
      graph_.poses()[loop.candidate].inverse() * graph_.poses()[loop.query];
  PoseEdge edge{loop.candidate, loop.query, loop.T_candidate_query, {}};
  const Matrix6d covariance = graph_.chain_covariance(loop.candidate, loop.query);
  edge.information = covariance.inverse();
  return squared_deviation(edge, expected) < kMaxSquaredDeviation;
}

/// Accepts the last loop if one of the keyframes before has a loop that agrees, and that one too.
std::vector<Loop> GlobalMap::confirm() {
  Loop& loop = loops_.back();
  const auto pose_by = [&](const Loop& l) -> Eigen::Isometry3d {
    // Pose of the new keyframe in the global frame, by the odometry since the loop.
    return graph_.poses()[l.candidate] * l.T_candidate_query * graph_.poses()[l.query].inverse() *
           graph_.poses()[loop.query];
  };
  const auto agrees = [&](std::size_t i) {
    const Eigen::Isometry3d difference = pose_by(loops_[i]).inverse() * pose_by(loop);
    return difference.translation().norm() < kMaxDifference && se3::angle(difference) < kMaxTurn;
  };
  std::erase_if(pending_,
                [&](std::size_t i) { return loops_[i].query + kConfirmation < loop.query; });
  std::vector<Loop> accepted;
  const auto other = std::find_if(pending_.begin(), pending_.end(), agrees);
  if (other == pending_.end()) {
    loop.outcome = LoopOutcome::kUnconfirmed;
  } else {
    if (std::exchange(loops_[*other].outcome, LoopOutcome::kAccepted) != LoopOutcome::kAccepted) {
      accepted.push_back(loops_[*other]);
    }
    accepted.push_back(loop);
  }
  pending_.push_back(loops_.size() - 1);
  for (const Loop& l : accepted) {
    graph_.add_loop({l.candidate, l.query, l.T_candidate_query, l.information});
  }
  return accepted;
}

std::optional<Relocalization> GlobalMap::relocalize(const GlobalKeyframe& frame) {
  const std::optional<StampedPose> before = std::exchange(recognized_, std::nullopt);
  const KeyframeRecord record = record_of(frame);
  std::vector<Eigen::Isometry3d> poses;  // by odometry: the place's local map is in its frame
  for (const KeyframeRecord& r : records_) poses.push_back(r.T_world_sensor.isometry());
  const std::vector<PlaceCandidate> candidates =
      recognizer_.find(record.keypoints.descriptors, records_.size(), kMaxRelocalized);
  for (const PlaceCandidate& candidate : candidates) {
    const Loop loop = verifier_.verify(records_, poses, candidate.keyframe, record);
    if (loop.outcome != LoopOutcome::kAccepted ||
        loop.inliers < kInlierFactor * config_.loops.min_inliers) {
      continue;
    }
    recognized_ = {record.stamp,
                   Transform<World, Sensor>(poses[loop.candidate] * loop.T_candidate_query)};
    if (!before || !agree(*before, *recognized_)) return std::nullopt;
    Relocalization result{recognized_->T_world_sensor, {}};
    const auto [first, end] = neighbors(loop.candidate, records_.size());
    for (std::size_t i = first; i < end; ++i) {
      result.surroundings.push_back({records_[i].features, poses[i]});
    }
    return result;
  }
  return std::nullopt;
}

void GlobalMap::solve() {
  for (const PoseEdge& removed : graph_.solve()) {
    for (Loop& loop : loops_) {
      if (loop.candidate == removed.a && loop.query == removed.b) {
        loop.outcome = LoopOutcome::kInconsistent;
      }
    }
  }
}

PoseCorrection GlobalMap::correction() const {
  PoseCorrection correction;
  if (graph_.loops().empty()) return correction;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Eigen::Isometry3d& pose = graph_.poses()[i];
    const Eigen::Isometry3d& odometry = records_[i].T_world_sensor.isometry();
    correction.add(records_[i].stamp, Transform<Global, World>(pose * odometry.inverse()));
  }
  return correction;
}

}  // namespace mms
