#include "mms/global_map/global_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
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

/// [-]: inliers of a loop between sessions that nothing relates, as a multiple of those of a loop.
/// Source: initial choice; `kSumFactor` decides.
constexpr double kLeastFactor = 1.25;

/// [-]: the same of all such loops that agree, together: two or three keyframes. Source: as
/// `kInlierFactor`, of two keyframes.
constexpr int kSumFactor = 4;

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

/// [1/m^2]: least information of a loop in a direction that its views do not determine. Source: a
/// standard deviation of 100 m, beyond every use.
constexpr double kMinInformation = 1e-4;

/// [-]: squared deviation of a loop up to which the pose graph is not solved for it alone.
/// Source: a fifth of a standard deviation in each of six directions.
constexpr double kSmallDeviation = 0.24;

/// [-]: loops after which it is solved in any case. Source: initial choice; about 5 m.
constexpr std::size_t kMaxUnsolved = 20;

/// [-]: last keyframes that move while a map is localized in. Source: initial choice, about 25 m;
/// loops to the map are much more frequent.
constexpr std::size_t kWindow = 100;

/// What is kept of a keyframe at a place that the map has.
KeyframeRecord pose_of(const KeyframeRecord& record) {
  KeyframeRecord pose;
  pose.stamp = record.stamp;
  pose.session = record.session;
  pose.T_world_sensor = record.T_world_sensor;
  pose.after_lost = record.after_lost;
  return pose;
}

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
  record.session = session_;
  record.T_world_sensor = keyframe.T_world_sensor;
  record.after_lost = keyframe.after_lost;
  record.keypoints = extract_keypoints(keyframe.color, keyframe.cloud, noise_);
  record.features = extractor_.extract(keyframe.cloud);
  record.features.intensity = {};
  record.view = make_keyframe_view(keyframe.cloud);
  return record;
}

void GlobalMap::restore(GlobalMapContent content, MapUse use) {
  assert(records_.empty() && content.poses.size() == content.records.size());
  for (KeyframeRecord& record : content.records) {
    add_node(record);
    recognizer_.add(record.keypoints.descriptors);
    records_.push_back(std::move(record));
  }
  if (!records_.empty()) graph_.set_poses(std::move(content.poses));
  loops_ = std::move(content.loops);
  for (const Loop& loop : loops_) {
    if (loop.outcome != LoopOutcome::kAccepted) continue;
    graph_.add_loop({loop.candidate, loop.query, loop.T_candidate_query, loop.information});
    sessions_.join(sessions_.session_of(loop.candidate), sessions_.session_of(loop.query));
  }
  session_ = sessions_.size();
  if (use == MapUse::kExtend) return;
  fixed_ = records_.size();
  graph_.fix(fixed_);
}

std::vector<Loop> GlobalMap::add(const GlobalKeyframe& keyframe) {
  return add(record_of(keyframe));
}

std::vector<Loop> GlobalMap::add(KeyframeRecord record) {
  add_node(record);
  const std::vector<Loop> accepted = find_loop(record);
  const bool is_in_map = std::any_of(accepted.begin(), accepted.end(),
                                     [&](const Loop& loop) { return loop.candidate < fixed_; });
  // The map has the place already: the memory of localization does not grow.
  if (is_in_map) record = pose_of(record);
  recognizer_.add(record.keypoints.descriptors);
  records_.push_back(std::move(record));
  recognized_.reset();
  solve_if_needed(accepted);
  return accepted;
}

/// Solves the pose graph where the loops move it, and at times for the others.
void GlobalMap::solve_if_needed(const std::vector<Loop>& accepted) {
  unsolved_ += accepted.size();
  const bool moves = std::any_of(accepted.begin(), accepted.end(), [&](const Loop& loop) {
    const PoseEdge edge{loop.candidate, loop.query, loop.T_candidate_query, loop.information};
    const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
    const Eigen::Isometry3d T = poses[loop.candidate].inverse() * poses[loop.query];
    return squared_deviation(edge, T) > kSmallDeviation;
  });
  if (moves || unsolved_ >= kMaxUnsolved) finish();
}

void GlobalMap::finish() {
  if (unsolved_ == 0) return;
  solve();
  unsolved_ = 0;
}

void GlobalMap::add_node(const KeyframeRecord& record) {
  const bool is_new_session = record.session >= sessions_.size();
  session_ = record.session;
  if (is_new_session) sessions_.add(records_.size());
  if (records_.empty()) {
    graph_ = PoseGraph(record.T_world_sensor.isometry());
    path_.push_back(0.0);
    return;
  }
  if (is_new_session) {
    // Its world is that of the map until a loop shows where it is.
    graph_.add_node(graph_.poses().back().inverse() * record.T_world_sensor.isometry(),
                    unknown_motion_information());
    path_.push_back(path_.back() + config_.min_path);
    return;
  }
  const Eigen::Isometry3d motion =
      records_.back().T_world_sensor.isometry().inverse() * record.T_world_sensor.isometry();
  graph_.add_node(motion, odometry_information(motion, record.after_lost));
  // What was seen before the sensor was lost is not recent.
  const double length = motion.translation().norm() + (record.after_lost ? config_.min_path : 0.0);
  path_.push_back(path_.back() + length);
}

bool GlobalMap::is_joined(std::uint32_t session) const {
  return session < sessions_.size() && sessions_.group_of(session) == 0;
}

/// Moves the sessions that a loop joins to the others: those that are not in the map's frame.
void GlobalMap::join(const Loop& loop) {
  const std::uint32_t earlier = sessions_.session_of(loop.candidate);
  const std::uint32_t later = sessions_.session_of(loop.query);
  const bool moves_later = sessions_.group_of(later) != 0;
  const std::uint32_t group = sessions_.group_of(moves_later ? later : earlier);
  const SessionGroups before = sessions_;
  if (!sessions_.join(earlier, later)) return;
  const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
  const Eigen::Isometry3d by_loop =
      poses[loop.candidate] * loop.T_candidate_query * poses[loop.query].inverse();
  const Eigen::Isometry3d T = moves_later ? by_loop : by_loop.inverse();
  for (std::uint32_t session = 0; session < before.size(); ++session) {
    if (before.group_of(session) != group) continue;
    const auto [first, end] = before.range(session, poses.size());
    graph_.move(first, end, T);
  }
}

/// Covariance of the pose of a keyframe relative to an earlier one, of a right perturbation of the
/// later one; nothing without a loop between their sessions.
std::optional<Matrix6d> GlobalMap::relative_covariance(std::size_t earlier,
                                                       std::size_t later) const {
  const std::uint32_t from = sessions_.session_of(earlier);
  const std::uint32_t to = sessions_.session_of(later);
  if (from == to) return graph_.chain_covariance(earlier, later);
  const auto link = std::find_if(loops_.rbegin(), loops_.rend(), [&](const Loop& loop) {
    return loop.outcome == LoopOutcome::kAccepted && sessions_.session_of(loop.candidate) == from &&
           sessions_.session_of(loop.query) == to;
  });
  if (link == loops_.rend()) return std::nullopt;
  const auto carry = [](const Matrix6d& covariance, const Eigen::Isometry3d& motion) -> Matrix6d {
    const Matrix6d moved = se3::adjoint(motion.inverse());
    return moved * covariance * moved.transpose();
  };
  Matrix6d covariance;  // of the link's earlier end relative to `earlier`
  if (earlier <= link->candidate) {
    covariance = graph_.chain_covariance(earlier, link->candidate);
  } else {
    const Eigen::Isometry3d back =
        graph_.poses()[earlier].inverse() * graph_.poses()[link->candidate];
    covariance = carry(graph_.chain_covariance(link->candidate, earlier), back);
  }
  covariance = carry(covariance, link->T_candidate_query) +
               (link->information + kMinInformation * Matrix6d::Identity()).inverse();
  const Eigen::Isometry3d since = graph_.poses()[link->query].inverse() * graph_.poses()[later];
  return carry(covariance, since) + graph_.chain_covariance(link->query, later);
}

/// Whether a keyframe may be the end of a loop of the present session.
bool GlobalMap::may_match(std::size_t candidate) const {
  if (records_[candidate].is_pose_only()) return false;
  // A map that is not corrected joins no sessions of its own.
  return candidate >= fixed_ || is_joined(records_[candidate].session);
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
    if (!sessions_.share_frame(records_[i].session, session_) || !may_match(i)) continue;
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
    const std::optional<Matrix6d> covariance = relative_covariance(keyframe, records_.size());
    if (!covariance) continue;
    const double variance = covariance->topLeftCorner<3, 3>().diagonal().maxCoeff();
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
    if (!may_match(candidate.keyframe)) continue;
    if (passes(verifier_.verify(records_, poses, candidate.keyframe, record))) {
      return confirm();
    }
  }
  return {};
}

/// Whether the odometry since the candidate allows the relative pose. Where nothing relates the
/// two, more keypoints must agree.
bool GlobalMap::is_likely(const Loop& loop) const {
  const std::optional<Matrix6d> covariance = relative_covariance(loop.candidate, loop.query);
  if (!covariance) return loop.inliers >= kLeastFactor * config_.loops.min_inliers;
  const Eigen::Isometry3d expected =
      graph_.poses()[loop.candidate].inverse() * graph_.poses()[loop.query];
  PoseEdge edge{loop.candidate, loop.query, loop.T_candidate_query, {}};
  edge.information = covariance->inverse();
  return squared_deviation(edge, expected) < kMaxSquaredDeviation;
}

/// Accepts the last loop if one of the keyframes before has a loop that agrees, and that one too.
/// Where nothing relates the sessions, all that agree need many keypoints together.
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
  std::vector<std::size_t> others;
  std::copy_if(pending_.begin(), pending_.end(), std::back_inserter(others), agrees);
  const bool is_related = relative_covariance(loop.candidate, loop.query).has_value();
  int inliers = loop.inliers;
  for (const std::size_t i : others) inliers += loops_[i].inliers;
  const bool is_confirmed =
      !others.empty() && (is_related || inliers >= kSumFactor * config_.loops.min_inliers);
  if (is_related && others.size() > 1) others.erase(others.begin() + 1, others.end());
  if (!is_confirmed) {
    loop.outcome = LoopOutcome::kUnconfirmed;
  } else {
    for (const std::size_t i : others) {
      if (std::exchange(loops_[i].outcome, LoopOutcome::kAccepted) == LoopOutcome::kAccepted) {
        continue;
      }
      accepted.push_back(loops_[i]);
    }
    accepted.push_back(loop);
  }
  pending_.push_back(loops_.size() - 1);
  for (const Loop& l : accepted) {
    join(l);
    graph_.add_loop({l.candidate, l.query, l.T_candidate_query, l.information});
  }
  return accepted;
}

/// Poses of all keyframes in the world of the present session: its own by odometry, those of others
/// by its present correction.
std::vector<Eigen::Isometry3d> GlobalMap::poses_in_world() const {
  const Eigen::Isometry3d T_world_global =
      records_.back().T_world_sensor.isometry() * graph_.poses().back().inverse();
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    poses.push_back(records_[i].session == session_ ? records_[i].T_world_sensor.isometry()
                                                    : T_world_global * graph_.poses()[i]);
  }
  return poses;
}

std::optional<Relocalization> GlobalMap::relocalize(const GlobalKeyframe& frame) {
  const std::optional<StampedPose> before = std::exchange(recognized_, std::nullopt);
  if (records_.empty() || records_.back().session != session_) return std::nullopt;
  const KeyframeRecord record = record_of(frame);
  const std::vector<Eigen::Isometry3d> poses = poses_in_world();
  const std::vector<PlaceCandidate> candidates =
      recognizer_.find(record.keypoints.descriptors, records_.size(), kMaxRelocalized);
  for (const PlaceCandidate& candidate : candidates) {
    const std::uint32_t session = records_[candidate.keyframe].session;
    if (!sessions_.share_frame(session, session_) || !may_match(candidate.keyframe)) continue;
    const Loop loop = verifier_.verify(records_, poses, candidate.keyframe, record);
    if (loop.outcome != LoopOutcome::kAccepted ||
        loop.inliers < kInlierFactor * config_.loops.min_inliers) {
      continue;
    }
    recognized_ = {record.stamp,
                   Transform<World, Sensor>(poses[loop.candidate] * loop.T_candidate_query)};
    if (!before || !agree(*before, *recognized_)) return std::nullopt;
    Relocalization result{recognized_->T_world_sensor, {}};
    const auto [first, end] = neighbors(records_, loop.candidate);
    for (std::size_t i = first; i < end; ++i) {
      result.surroundings.push_back({records_[i].features, poses[i]});
    }
    return result;
  }
  return std::nullopt;
}

void GlobalMap::solve() {
  if (fixed_ > 0)
    graph_.fix(std::max(fixed_, records_.size() - std::min(records_.size(), kWindow)));
  for (const PoseEdge& removed : graph_.solve()) {
    for (Loop& loop : loops_) {
      if (loop.candidate == removed.a && loop.query == removed.b) {
        loop.outcome = LoopOutcome::kInconsistent;
      }
    }
  }
}

PoseCorrection GlobalMap::correction(std::uint32_t session) const {
  return session_correction(records_, graph_.poses(), loops_, session);
}

PoseCorrection session_correction(const std::deque<KeyframeRecord>& records,
                                  const std::vector<Eigen::Isometry3d>& poses,
                                  const std::vector<Loop>& loops, std::uint32_t session) {
  PoseCorrection correction;
  const bool has_loops = std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    return loop.outcome == LoopOutcome::kAccepted &&
           (records[loop.candidate].session == session || records[loop.query].session == session);
  });
  if (!has_loops) return correction;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i].session != session) continue;
    const Eigen::Isometry3d& odometry = records[i].T_world_sensor.isometry();
    correction.add(records[i].stamp, Transform<Global, World>(poses[i] * odometry.inverse()));
  }
  return correction;
}

}  // namespace mms
