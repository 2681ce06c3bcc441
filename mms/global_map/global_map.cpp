#include "mms/global_map/global_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/keyframes/keypoint_extraction.hpp"
#include "mms/global_map/keyframes/scan_keypoints.hpp"
#include "mms/global_map/places/best_apart.hpp"
#include "mms/mapping/ground/floor.hpp"

namespace mms {
namespace {

/// [-]: candidates of a keyframe by place recognition. Source: computing time.
constexpr std::size_t kMaxRecognized = 3;

/// [-]: candidates of a keyframe by position. Source: computing time.
constexpr std::size_t kMaxNearby = 2;

/// [m]: distance of candidates by position. Source: initial choice; views beyond share too little.
constexpr double kNearby = 1.0;

/// [rad]: angle between the views of candidates by position. Source: as `kNearby`.
constexpr double kNearbyTurn = std::numbers::pi / 6.0;

/// [m]: largest standard deviation of a position by the odometry for candidates by position.
/// Source: registration converges from three of them; structures that repeat are farther apart.
constexpr double kMaxNearbySigma = 0.15;

/// [m]: path since the candidates of a scan by place recognition. Source: their local maps, of 10 m
/// each, then share no scans.
constexpr double kScanPath = 20.0;

/// [m]: distance along the floor of keyframes around a place that a user gives. Source: initial
/// choice; a click on a map may be that far off.
constexpr double kMaxExpectedDistance = 2.0;

/// [rad]: the same of the angle between the views. Source: as `kMaxExpectedDistance`; 60 degrees.
constexpr double kMaxExpectedTurn = std::numbers::pi / 3.0;

/// [-]: such candidates of a keyframe. Source: computing time.
constexpr std::size_t kMaxExpected = 6;

/// [-]: keyframes beside one of them up to which none is another candidate. Source: about 0.5 m.
constexpr std::size_t kExpectedSpacing = 2;

/// [-]: visits of a place whose views are kept, where a loop recognizes it. Source: memory; people
/// may cover much of a view.
constexpr std::size_t kMaxVisits = 3;

/// [-]: the same where none does, since it may look otherwise by now. Source: memory.
constexpr std::size_t kMaxUnrecognizedVisits = 6;

/// [m]: path since a loop up to which it tells where the sensor is. Source: the odometry drifts by
/// some centimeters, and keyframes are 0.25 m apart.
constexpr double kKnownPath = 20.0;

/// [-]: keyframes between those of two visits of a place. Source: initial choice; 2 m of path.
constexpr std::size_t kBetweenVisits = 8;

/// What is kept of a keyframe at a place that the map has.
KeyframeRecord pose_of(const KeyframeRecord& record) {
  KeyframeRecord pose;
  pose.stamp = record.stamp;
  pose.session = record.session;
  pose.T_world_sensor = record.T_world_sensor;
  pose.after_lost = record.after_lost;
  return pose;
}

/// Whether a session has loops, within it or to others.
bool has_loops(const std::deque<KeyframeRecord>& records, const std::vector<Loop>& loops,
               std::uint32_t session) {
  return std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    return loop.outcome == LoopOutcome::kAccepted &&
           (records[loop.candidate].session == session || records[loop.query].session == session);
  });
}

}  // namespace

GlobalMap::GlobalMap(const GlobalMapConfig& config, const FeatureConfig& features,
                     const RegistrationConfig& registration)
    : config_(config),
      extractor_(features),
      noise_(features.noise.depth),
      verifier_(config.loops, registration, noise_),
      lost_verifier_(config.loops, registration, noise_),
      graph_(std::max(config.min_path, kScanPath)) {}

KeyframeRecord GlobalMap::record_of(const GlobalKeyframe& keyframe) const {
  KeyframeRecord record;
  record.stamp = keyframe.cloud.stamp;
  record.session = session();
  record.T_world_sensor = keyframe.T_world_sensor;
  record.after_lost = keyframe.after_lost;
  record.features = extractor_.extract(keyframe.cloud);
  record.features.intensity = {};
  if (!keyframe.cloud.organised()) return record;
  record.keypoints = extract_keypoints(keyframe.color, keyframe.cloud, noise_);
  record.view = make_keyframe_view(keyframe.color, keyframe.cloud);
  return record;
}

/// A scan is recognized by those around it, since it is sparse.
void GlobalMap::describe_scan(const GlobalKeyframe& keyframe, KeyframeRecord& record) {
  if (keyframe.after_lost) scans_.clear();
  scans_.add(keyframe.cloud, keyframe.T_world_sensor);
  std::vector<Eigen::Vector3f> points = scans_.points();
  record.scan = make_scan_view(keyframe.cloud);
  const Eigen::Vector3d up =
      keyframe.T_world_sensor.isometry().linear().transpose() * SensorAxes::lidar().up;
  record.scan.T_sensor_floor = floor_frame(points, up);
  record.keypoints = extract_scan_keypoints(std::move(points), record.scan.T_sensor_floor);
}

void GlobalMap::restore(GlobalMapContent content, MapUse use) {
  assert(records_.empty() && content.poses.size() == content.records.size());
  for (KeyframeRecord& record : content.records) {
    graph_.add_node(record);
    recognizer_.add(record.keypoints.descriptors);
    scan_places_.add(record.scan);
    records_.push_back(std::move(record));
  }
  graph_.restore(std::move(content.poses), std::move(content.loops));
  if (use == MapUse::kLocalizeOnly) graph_.fix();
  earlier_sessions_ = session();
}

std::vector<Loop> GlobalMap::add(const GlobalKeyframe& keyframe) {
  KeyframeRecord record = record_of(keyframe);
  if (run_sessions_.empty() || run_sessions_.back() != keyframe.session) {
    run_sessions_.push_back(keyframe.session);
    record.session = earlier_sessions_ + static_cast<std::uint32_t>(run_sessions_.size()) - 1U;
  }
  if (!keyframe.cloud.organised()) describe_scan(keyframe, record);
  // A sensor that stands there has no second keyframe to confirm a loop.
  const std::optional<FoundPlace> place = std::exchange(found_place_, std::nullopt);
  std::vector<Loop> known;
  if (place && place->stamp == record.stamp && record.after_lost) known.push_back(place->loop);
  return add(std::move(record), keyframe.expected_place, known);
}

std::vector<Loop> GlobalMap::add(KeyframeRecord record,
                                 const std::optional<Transform<Global, Sensor>>& expected,
                                 const std::vector<Loop>& known) {
  graph_.add_node(record);
  const bool has_known = record.is_pose_only() || !known.empty();
  const std::vector<Loop> accepted = first_loop_ ? join_session(record)
                                     : has_known ? take(known)
                                                 : find_loop(record, expected);
  const bool is_in_map = std::any_of(accepted.begin(), accepted.end(), [&](const Loop& loop) {
    return graph_.is_fixed(loop.candidate);
  });
  // The map has the place already: its memory grows with places, not with time.
  if (is_in_map || has_enough_views(record, accepted)) record = pose_of(record);
  recognizer_.add(record.keypoints.descriptors);
  scan_places_.add(record.scan);
  records_.push_back(std::move(record));
  relocalizer_.reset();
  graph_.solve_if_needed(accepted);
  return accepted;
}

/// Whether the views of several visits of the present session show the place of the next keyframe.
/// Those of other sessions do not count: views of each tell what changed between them.
/// @param accepted  loops that were accepted with it
bool GlobalMap::has_enough_views(const KeyframeRecord& record,
                                 const std::vector<Loop>& accepted) const {
  const auto own = std::find_if(accepted.begin(), accepted.end(),
                                [&](const Loop& loop) { return loop.query == records_.size(); });
  const bool is_recognized = own != accepted.end();
  const KeyframeConfig& same = record.is_scan() ? config_.scan_keyframes : config_.keyframes;
  const Eigen::Isometry3d T_sensor_global =
      (is_recognized ? graph_.poses()[own->candidate] * own->T_candidate_query
                     : graph_.poses().back())
          .inverse();
  std::size_t visits = 0;
  std::size_t next = 0;  // the first keyframe that is of another visit
  const std::size_t end = graph_.first_recent(config_.min_path);
  for (std::size_t i = 0; i < end; ++i) {
    if (records_[i].session != session() || records_[i].is_pose_only()) continue;
    const Eigen::Isometry3d relative = T_sensor_global * graph_.poses()[i];
    if (relative.translation().norm() > same.translation ||
        se3::angle(relative) * 180.0 / std::numbers::pi > same.rotation) {
      continue;
    }
    if (i >= next) ++visits;
    next = i + kBetweenVisits;
  }
  if (is_recognized) return visits >= kMaxVisits;
  return visits >= kMaxUnrecognizedVisits && is_place_known();
}

/// Whether a loop within the present session tells where the next keyframe is.
bool GlobalMap::is_place_known() const {
  const std::size_t first = graph_.first_recent(kKnownPath);
  return std::any_of(graph_.loops().rbegin(), graph_.loops().rend(), [&](const Loop& loop) {
    return loop.outcome == LoopOutcome::kAccepted && loop.query >= first &&
           records_[loop.candidate].session == session();
  });
}

/// Whether the place of a lost frame was recognized, not only confirmed by geometry.
bool GlobalMap::is_sure(const Loop& place) const {
  return records_[place.candidate].is_scan() ||
         place.inliers >= kLostFactor * config_.loops.min_inliers;
}

/// Joins a session to the place where a relocalization began it.
/// @param first  its first keyframe, the next one; its world is the frame of that place
std::vector<Loop> GlobalMap::join_session(const KeyframeRecord& first) {
  Loop loop = *std::exchange(first_loop_, std::nullopt);
  loop.T_candidate_query =
      graph_.poses()[loop.candidate].inverse() * first.T_world_sensor.isometry();
  loop.query = records_.size();
  graph_.add_check(loop);
  graph_.add_edges({loop});
  return {loop};
}

/// Takes loops that another map has found.
std::vector<Loop> GlobalMap::take(const std::vector<Loop>& known) {
  for (const Loop& loop : known) graph_.add_check(loop);
  graph_.add_edges(known);
  return known;
}

/// Whether a keyframe may be the end of a loop of the present session.
bool GlobalMap::may_match(std::size_t candidate) const {
  if (records_[candidate].is_pose_only()) return false;
  // A map that is not corrected joins no sessions of its own.
  return !graph_.is_fixed(candidate) || is_joined(records_[candidate].session);
}

/// Earlier keyframes that look in nearly the same direction from nearly the same position.
std::vector<std::size_t> GlobalMap::nearby(std::size_t end) const {
  std::vector<std::pair<double, std::size_t>> near;
  const Eigen::Isometry3d T_sensor_global = graph_.poses().back().inverse();
  for (std::size_t i = 0; i < end; ++i) {
    if (!graph_.shares_frame(i) || !may_match(i)) continue;
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
    const std::optional<Matrix6d> covariance =
        graph_.relative_covariance(keyframe, records_.size());
    if (!covariance) continue;
    const double variance = covariance->topLeftCorner<3, 3>().diagonal().maxCoeff();
    if (variance < kMaxNearbySigma * kMaxNearbySigma) keyframes.push_back(keyframe);
  }
  return keyframes;
}

/// Keyframes of the map around a place that a user gives, whose height is not known.
std::vector<std::size_t> GlobalMap::around(const Transform<Global, Sensor>& expected) const {
  using Near = std::pair<double, std::size_t>;  // how far, and the keyframe
  std::vector<Near> near;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    if (!is_joined(records_[i].session) || !may_match(i)) continue;
    const Eigen::Vector3d up =
        (records_[i].is_scan() ? SensorAxes::lidar() : SensorAxes::camera()).up;
    const Eigen::Vector3d shift = graph_.poses()[i].translation() - expected.translation();
    const double distance = (shift - up * up.dot(shift)).norm();
    const double turn = se3::angle(graph_.poses()[i].inverse() * expected.isometry());
    if (distance < kMaxExpectedDistance && turn < kMaxExpectedTurn) {
      near.emplace_back(distance + turn, i);
    }
  }
  std::sort(near.begin(), near.end());
  std::vector<std::size_t> keyframes;
  for (const Near& best : best_apart(near, kMaxExpected, kExpectedSpacing, &Near::second)) {
    keyframes.push_back(best.second);
  }
  return keyframes;
}

/// Checks the candidates of the next keyframe until one is accepted: first those at its position,
/// then those around the expected place, then those that place recognition finds.
std::vector<Loop> GlobalMap::find_loop(const KeyframeRecord& record,
                                       const std::optional<Transform<Global, Sensor>>& expected) {
  const std::vector<Eigen::Isometry3d>& poses = graph_.poses();
  const std::size_t end = graph_.first_recent(config_.min_path);
  const int min_inliers = min_inliers_of(config_.loops, record);
  const auto passes = [&](Loop loop) {
    const bool verified = loop.outcome == LoopOutcome::kAccepted;
    if (verified && !confirmation_.is_likely(graph_, loop, min_inliers))
      loop.outcome = LoopOutcome::kUnlikely;
    return graph_.add_check(std::move(loop));
  };
  std::vector<Loop> accepted;
  const auto confirm = [&] {
    const std::vector<Loop> loops = confirmation_.confirm(graph_, min_inliers);
    accepted.insert(accepted.end(), loops.begin(), loops.end());
  };
  bool is_found = false;
  for (const std::size_t candidate : nearby(end)) {
    const Eigen::Isometry3d by_odometry = poses[candidate].inverse() * poses.back();
    is_found = passes(verifier_.verify_nearby(records_, poses, candidate, record, by_odometry));
    if (!is_found) continue;
    confirm();
    break;
  }
  // A session that is not in the map is compared with it at known places of its own, too.
  if (is_found && is_joined(session())) return accepted;
  std::vector<std::size_t> candidates;
  if (expected && !is_joined(session())) candidates = around(*expected);
  const auto is_usable = [&](std::size_t i) {
    return may_match(i) && !(is_found && graph_.shares_frame(i));
  };
  for (const PlaceCandidate& candidate : recognizer_.find(
           record.keypoints.descriptors, record.is_scan() ? graph_.first_recent(kScanPath) : end,
           kMaxRecognized, is_usable)) {
    candidates.push_back(candidate.keyframe);
  }
  for (const std::size_t i : candidates) {
    // Another session of the run: after a loss, people may cover the view, and nothing was moved
    // since, so that places which only look alike contradict.
    const bool is_after_loss = !record.is_scan() && !graph_.shares_frame(i) &&
                               !run_sessions_.empty() && records_[i].session >= earlier_sessions_;
    if (passes(is_after_loss ? lost_verifier_.verify(records_, poses, i, record)
                             : verifier_.verify(records_, poses, i, record))) {
      confirm();
      return accepted;
    }
  }
  if (!record.is_scan() || is_joined(session())) return accepted;
  // A sensor that stands has no local map.
  std::optional<Loop> loop = place_of_scan(
      record, poses, [&](std::size_t i) { return may_match(i) && !graph_.shares_frame(i); });
  if (!loop) return accepted;
  // Two scans join the session, since a whole scan fits no other place.
  loop->inliers = 2 * min_inliers;
  if (passes(*std::move(loop))) confirm();
  return accepted;
}

std::optional<Loop> GlobalMap::place_of_scan(const KeyframeRecord& scan,
                                             const std::vector<Eigen::Isometry3d>& poses,
                                             const ScanPlaces::IsUsable& is_usable) const {
  const auto share_frame = [&](std::size_t a, std::size_t b) {
    return graph_.are_in_one_frame(a, b);
  };
  return find_place_of_scan({records_, poses, scan_places_, verifier_, is_usable, share_frame},
                            config_.loops, scan);
}

/// The record of a lost scan, of which no scans around are known.
KeyframeRecord GlobalMap::record_of_lost(const GlobalKeyframe& frame) const {
  KeyframeRecord record = record_of(frame);
  if (frame.cloud.organised()) return record;
  LocalScans alone;
  alone.add(frame.cloud, frame.T_world_sensor);
  const Eigen::Vector3d up =
      frame.T_world_sensor.isometry().linear().transpose() * SensorAxes::lidar().up;
  record.scan = make_scan_view(frame.cloud);
  record.scan.T_sensor_floor = floor_frame(alone.points(), up);
  return record;
}

/// Poses of all keyframes in the world of the present session: its own by odometry, those of others
/// by its present correction.
std::vector<Eigen::Isometry3d> GlobalMap::poses_in_world() const {
  const Eigen::Isometry3d T_world_global =
      records_.back().T_world_sensor.isometry() * graph_.poses().back().inverse();
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    poses.push_back(records_[i].session == session() ? records_[i].T_world_sensor.isometry()
                                                     : T_world_global * graph_.poses()[i]);
  }
  return poses;
}

/// @param loop  of the frame, whose candidate is at one of the poses
Relocalization GlobalMap::relocalization_at(const Loop& loop,
                                            const std::vector<Eigen::Isometry3d>& poses) {
  Relocalization result;
  result.begins_session = !graph_.shares_frame(loop.candidate);
  const std::vector<Eigen::Isometry3d>& placed = result.begins_session ? graph_.poses() : poses;
  result.T_world_sensor = Transform<World, Sensor>(placed[loop.candidate] * loop.T_candidate_query);
  const auto [first, end] = neighbors(records_, loop.candidate);
  for (std::size_t i = first; i < end; ++i) {
    result.surroundings.push_back({records_[i].features, placed[i]});
  }
  if (!result.begins_session) return result;
  first_loop_ = loop;
  if (is_joined(records_[loop.candidate].session)) {
    result.T_global_world = Transform<Global, World>();
  }
  return result;
}

std::optional<Relocalization> GlobalMap::relocalize(const GlobalKeyframe& frame) {
  if (run_sessions_.empty() || run_sessions_.back() != frame.session) {
    relocalizer_.reset();
    return std::nullopt;
  }
  const std::vector<Eigen::Isometry3d> poses = poses_in_world();
  const auto is_usable = [&](std::size_t keyframe) { return may_match(keyframe); };
  const auto shares_frame = [&](std::size_t keyframe) { return graph_.shares_frame(keyframe); };
  const auto place_of = [&](const KeyframeRecord& scan) {
    return place_of_scan(scan, poses, is_usable);
  };
  const auto loop = relocalizer_.find(
      {records_, poses, recognizer_, lost_verifier_, is_usable, shares_frame, place_of},
      record_of_lost(frame), frame.has_pose);
  found_place_.reset();
  if (!loop) return std::nullopt;
  Relocalization place = relocalization_at(*loop, poses);
  if (!place.begins_session && is_sure(*loop)) found_place_ = {frame.cloud.stamp, *loop};
  return place;
}

std::optional<Transform<Global, World>> GlobalMap::last_correction() const {
  const Transform<Global, World> none;
  if (records_.empty()) return none;
  if (!is_joined(session())) return std::nullopt;
  if (!has_loops(records_, graph_.loops(), session())) return none;
  return Transform<Global, World>(graph_.poses().back() *
                                  records_.back().T_world_sensor.isometry().inverse());
}

std::optional<std::uint32_t> GlobalMap::session_of_run(std::uint32_t session) const {
  const auto found = std::lower_bound(run_sessions_.begin(), run_sessions_.end(), session);
  if (found == run_sessions_.end() || *found != session) return std::nullopt;
  return earlier_sessions_ + static_cast<std::uint32_t>(found - run_sessions_.begin());
}

PoseCorrection GlobalMap::correction(std::uint32_t session) const {
  return session_correction(records_, graph_.poses(), graph_.loops(), session);
}

PoseCorrection session_correction(const std::deque<KeyframeRecord>& records,
                                  const std::vector<Eigen::Isometry3d>& poses,
                                  const std::vector<Loop>& loops, std::uint32_t session) {
  PoseCorrection correction;
  if (!has_loops(records, loops, session)) return correction;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i].session != session) continue;
    const Eigen::Isometry3d& odometry = records[i].T_world_sensor.isometry();
    correction.add(records[i].stamp, Transform<Global, World>(poses[i] * odometry.inverse()));
  }
  return correction;
}

}  // namespace mms
