#include "mms/global_map/loops/lost_verification.hpp"

#include <algorithm>
#include <numbers>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/loops/place_matching.hpp"
#include "mms/global_map/loops/point_alignment.hpp"

namespace mms {
namespace {

/// [-]: pairs of keypoints that agree with a first pose of a lost frame. Source: of 600 right
/// places, 98 % had more; wrong ones cost time alone.
constexpr int kMinSeeds = 8;

/// [-]: rounds of pairs and least squares. Source: the second one has the better pose.
constexpr int kRounds = 2;

/// [-]: as `kLostFactor`, where the odometry has this pose. Source: in a hall that is turned by
/// half a turn, geometry confirmed wrong poses with at most one pair.
constexpr double kConfirmFactor = 0.5;

/// [-]: pairs of keypoints that confirm the odometry's pose though the view contradicts, as a
/// multiple of those of a loop. Source: people without a mask contradict by up to 16 % in
/// `lab_crowd`, where 96 pairs or more agreed; similar places had at most 54.
constexpr double kSureFactor = 4.0;

/// [rad]: largest change of the pose of a lost frame by the registration. Source: of 57 accepted
/// views 53 changed by less than 1 degree; two of 3 degrees and more were wrong or uncertain.
constexpr double kMaxLostTurn = 2.0 * std::numbers::pi / 180.0;

/// [-]: overlap of a lost frame. Source: people who cover half of the view leave 0.15 to 0.2.
constexpr double kMinLostOverlap = 0.15;

/// [-]: mean contradiction of these views and a lost frame, beyond the noise. Source: of 410 right
/// places 99 % had less than 0.0004, of 16 wrong ones 90 % more.
constexpr double kMaxLostContradiction = 0.001;

/// [-]: the same as a multiple of the contradiction of these views among each other. Source: their
/// poses are right, so that it is noise; initial choice.
constexpr double kNoiseFactor = 2.0;

/// Settings by which `kMinSeeds` pairs are enough for a first pose, similar ones and those that
/// agree.
LoopConfig for_seeds(LoopConfig config) {
  config.min_inliers = std::min(config.min_inliers, kMinSeeds);
  return config;
}

/// Distance and angle of two poses [m, rad].
double view_distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d T = a.inverse() * b;
  return T.translation().norm() + se3::angle(T);
}

}  // namespace

LostFrameVerifier::LostFrameVerifier(const LoopConfig& config,
                                     const RegistrationConfig& registration,
                                     const DepthNoise& noise)
    : config_(config),
      aligner_(for_seeds(config), noise),
      loops_(config, registration, noise),
      noise_(noise) {}

Loop LostFrameVerifier::verify(const std::deque<KeyframeRecord>& records,
                               const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                               const KeyframeRecord& query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  aligner_.align(records[candidate], query, loop);
  if (loop.inliers < kMinSeeds) return loop;
  const auto [first, end] = neighbors(records, candidate);
  const PlacedKeypoints place = keypoints_at(records, poses, first, end, noise_);
  Eigen::Isometry3d pose = poses[candidate] * loop.T_candidate_query;
  PlaceMatches matches;
  PointAlignment alignment;
  for (int round = 0; round < kRounds; ++round) {
    matches = match_at_place(place, query.keypoints, pose, noise_);
    alignment = refine_alignment(matches.pairs, pose);
    pose = alignment.T_a_b;
  }
  const double min_pairs = kLostFactor * config_.min_inliers;
  loop.inliers = static_cast<int>(alignment.inliers.size());
  loop.outcome = LoopOutcome::kFewInliers;
  if (loop.inliers < min_pairs) return loop;
  std::vector<Eigen::Vector2f> pixels;
  for (const std::size_t i : alignment.inliers)
    pixels.push_back(query.keypoints.pixels[matches.frames[i]]);
  loop.outcome = LoopOutcome::kNotSpread;
  if (!is_spread(pixels)) return loop;
  // The nearest view shares most.
  for (std::size_t i = first; i < end; ++i) {
    if (!records[i].is_pose_only() &&
        view_distance(poses[i], pose) < view_distance(poses[loop.candidate], pose))
      loop.candidate = i;
  }
  loop.T_candidate_query = poses[loop.candidate].inverse() * pose;
  check(records, poses, query, std::min(config_.min_overlap, kMinLostOverlap), min_pairs, loop);
  const double turn = se3::angle(pose.inverse() * poses[loop.candidate] * loop.T_candidate_query);
  if (turn > kMaxLostTurn) loop.outcome = LoopOutcome::kNotRegistered;
  return loop;
}

Loop LostFrameVerifier::verify_nearby(const std::deque<KeyframeRecord>& records,
                                      const std::vector<Eigen::Isometry3d>& poses,
                                      std::size_t candidate, const KeyframeRecord& query,
                                      const Eigen::Isometry3d& T_candidate_query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  loop.T_candidate_query = T_candidate_query;
  const bool has_texture = query.keypoints.size() >= static_cast<std::size_t>(config_.min_inliers);
  check(records, poses, query, config_.min_overlap,
        has_texture ? kConfirmFactor * config_.min_inliers : 0.0, loop);
  if (loop.outcome != LoopOutcome::kContradiction) return loop;
  loop.inliers = pairs_at(records, poses, query, loop);
  if (loop.inliers >= kSureFactor * config_.min_inliers) loop.outcome = LoopOutcome::kAccepted;
  return loop;
}

/// Pairs of keypoints of the candidate's place and a frame that agree with the loop.
int LostFrameVerifier::pairs_at(const std::deque<KeyframeRecord>& records,
                                const std::vector<Eigen::Isometry3d>& poses,
                                const KeyframeRecord& query, const Loop& loop) const {
  const Eigen::Isometry3d pose = poses[loop.candidate] * loop.T_candidate_query;
  const auto [first, end] = neighbors(records, loop.candidate);
  const PlaceMatches matches = match_at_place(keypoints_at(records, poses, first, end, noise_),
                                              query.keypoints, pose, noise_);
  return static_cast<int>(inliers_of(matches.pairs, pose).size());
}

/// The checks of a lost frame at a pose: where geometry repeats, the keypoints must agree with the
/// registered pose, too. Similar places differ by what some of the views around show.
void LostFrameVerifier::check(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses,
                              const KeyframeRecord& query, double min_overlap, double min_pairs,
                              Loop& loop) const {
  if (!loops_.is_same_place(records, poses, query, min_overlap, loop)) return;
  const Eigen::Isometry3d& pose_of_candidate = poses[loop.candidate];
  const Eigen::Isometry3d pose = pose_of_candidate * loop.T_candidate_query;
  loop.inliers = pairs_at(records, poses, query, loop);
  loop.outcome = LoopOutcome::kFewInliers;
  if (loop.inliers < min_pairs) return;
  const double noise = contradiction_around(records, poses, loop.candidate,
                                            records[loop.candidate].view, pose_of_candidate);
  loop.contradiction = contradiction_around(records, poses, loop.candidate, query.view, pose);
  loop.outcome = loop.contradiction > kMaxLostContradiction + kNoiseFactor * noise
                     ? LoopOutcome::kContradiction
                     : LoopOutcome::kAccepted;
}

/// Mean share of points in free space between a view and those of the keyframes around one.
double LostFrameVerifier::contradiction_around(const std::deque<KeyframeRecord>& records,
                                               const std::vector<Eigen::Isometry3d>& poses,
                                               std::size_t keyframe, const KeyframeView& view,
                                               const Eigen::Isometry3d& pose) const {
  const auto [first, end] = neighbors(records, keyframe, kViewsAround);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = first; i < end; ++i) {
    if (records[i].is_pose_only() || &records[i].view == &view) continue;
    const Eigen::Isometry3d T = poses[i].inverse() * pose;
    sum += compare_views(records[i].view, view, T, noise_).contradiction +
           compare_views(view, records[i].view, T.inverse(), noise_).contradiction;
    count += 2;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace mms
