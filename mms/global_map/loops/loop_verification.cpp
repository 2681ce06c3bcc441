#include "mms/global_map/loops/loop_verification.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mms/geometry/principal_axes.hpp"
#include "mms/global_map/keyframes/view_texture.hpp"
#include "mms/global_map/loops/floor_alignment.hpp"
#include "mms/global_map/loops/keypoint_matching.hpp"
#include "mms/global_map/loops/place_matching.hpp"
#include "mms/global_map/loops/point_alignment.hpp"

namespace mms {
namespace {

/// [-]: columns of the cells of an image that inliers must spread over. Source: initial choice.
constexpr float kColumns = 8.0F;

/// [-]: rows of these cells. Source: squares, with `kColumns`.
constexpr float kRows = 6.0F;

/// [-]: cells with inliers, at least. Source: initial choice; a sign or a pallet fills about four.
constexpr std::size_t kMinCells = 6;

/// [-]: pairs of keypoints that agree with a first pose of a lost frame. Source: of 600 right
/// places, 98 % had more; wrong ones cost time alone.
constexpr int kMinSeeds = 8;

/// [-]: rounds of pairs and least squares. Source: the second one has the better pose.
constexpr int kRounds = 2;

/// [-]: pairs of keypoints of a lost frame, as a multiple of those of a loop. Source: no odometry
/// confirms the place; in a hall that is turned by half a turn, views agree in up to 1.5.
constexpr double kLostFactor = 1.5;

/// [-]: the same where the odometry has this pose. Source: in a hall that is turned by half a turn,
/// geometry confirmed wrong poses with at most one pair.
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

/// [-]: keyframes before and after a place whose views are compared with a lost frame. Source: in
/// places that look alike, a part of them shows a difference; 1.5 m on each side.
constexpr std::size_t kViewsAround = 6;

/// [-]: mean contradiction of these views and a lost frame, beyond the noise. Source: of 410 right
/// places 99 % had less than 0.0004, of 16 wrong ones 90 % more.
constexpr double kMaxLostContradiction = 0.001;

/// [-]: the same as a multiple of the contradiction of these views among each other. Source: their
/// poses are right, so that it is noise; initial choice.
constexpr double kNoiseFactor = 2.0;

/// [-]: bound on the voxels of the candidate's local map. Source: far more than seven views fill.
constexpr std::size_t kMaxVoxels = 100000;

/// [-]: share of the features that must fit the candidate's map. Source: as `min_inlier_share` of
/// the odometry; the view is another one.
constexpr double kMinFit = 0.25;

/// [m]: largest change of the first pose by the registration. Source: keypoints are good to some
/// centimeters; more is another minimum.
constexpr double kMaxShift = 0.2;

/// [rad]: the same of the rotation. Source: as `kMaxShift`; 5 degrees.
constexpr double kMaxTurn = 5.0 * std::numbers::pi / 180.0;

/// [m]: the same of scans. Source: density images are good to some pixels of 0.1 m.
constexpr double kMaxScanShift = 0.5;

/// [m]: distance of the places of a pair of keypoints on the floor. Source: three pixels.
constexpr double kMaxPlaceError = 0.3;

/// [m]: least standard deviation of the places of inliers along their longer side. Source: initial
/// choice; a rack of pallets is shorter.
constexpr double kMinLength = 2.0;

/// [m]: the same along the shorter side. Source: initial choice; one row of posts is thinner.
constexpr double kMinWidth = 0.5;

/// [-]: correlated residuals of a view that count as one measurement. Source: initial choice.
constexpr double kResidualsPerMeasurement = 30.0;

/// [m]: standard deviation of a loop beside the registration's own, which assumes independent
/// residuals. Source: errors of 93 loops of `warehouse_loop`: median 0.4 cm, 95 % below 1 cm.
constexpr double kTranslationFloor = 0.01;

/// [rad]: the same of the rotation. Source: median 0.03 degrees, 95 % below 0.1 degrees.
constexpr double kRotationFloor = 0.1 * std::numbers::pi / 180.0;

/// Distance and angle of two poses [m, rad].
double view_distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d T = a.inverse() * b;
  return T.translation().norm() + se3::angle(T);
}

bool is_spread(const std::vector<Eigen::Vector2d>& places, const std::vector<std::size_t>& chosen) {
  PointSums<double, 2> sums;
  for (const std::size_t i : chosen) sums.add(places[i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(sums.covariance());
  return axes.eigenvalues()(0) > kMinWidth * kMinWidth &&
         axes.eigenvalues()(1) > kMinLength * kMinLength;
}

bool is_spread(const std::vector<Eigen::Vector2f>& pixels) {
  std::set<int> cells;
  for (const Eigen::Vector2f& pixel : pixels) {
    cells.insert(static_cast<int>(pixel.y() * kRows) * static_cast<int>(kColumns) +
                 static_cast<int>(pixel.x() * kColumns));
  }
  return cells.size() >= kMinCells;
}

/// Information with the noise floor; directions that the data do not determine stay zero.
Matrix6d with_floor(const Matrix6d& information) {
  Vector6d scale;
  scale.head<3>().setConstant(kTranslationFloor);
  scale.tail<3>().setConstant(kRotationFloor);
  // In units of the floor, so that the eigenvectors mix no meters with radians.
  const Matrix6d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  const Vector6d values = eigen.eigenvalues().cwiseMax(0.0);
  const Vector6d bounded = values.array() / (values.array() + 1.0);
  const Matrix6d result =
      eigen.eigenvectors() * bounded.asDiagonal() * eigen.eigenvectors().transpose();
  const Vector6d inverse = scale.cwiseInverse();
  return inverse.asDiagonal() * result * inverse.asDiagonal();
}

}  // namespace

std::pair<std::size_t, std::size_t> neighbors(const std::deque<KeyframeRecord>& records,
                                              std::size_t keyframe, std::size_t count) {
  std::size_t first = keyframe - std::min(keyframe, count);
  std::size_t end = std::min(keyframe + count + 1, records.size());
  const std::uint32_t session = records[keyframe].session;
  while (records[first].session != session) ++first;
  while (records[end - 1].session != session) --end;
  return {first, end};
}

int min_inliers_of(const LoopConfig& config, const KeyframeRecord& keyframe) {
  return keyframe.is_scan() ? config.min_scan_inliers : config.min_inliers;
}

LoopVerifier::LoopVerifier(const LoopConfig& config, const RegistrationConfig& registration,
                           const DepthNoise& noise)
    : config_(config), registration_(registration), noise_(noise) {}

Loop LoopVerifier::verify(const std::deque<KeyframeRecord>& records,
                          const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                          const KeyframeRecord& query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  if (align(records[candidate], query, loop) &&
      is_same_place(records, poses, query, config_.min_overlap, loop)) {
    loop.outcome = LoopOutcome::kAccepted;
  }
  return loop;
}

Loop LoopVerifier::verify_nearby(const std::deque<KeyframeRecord>& records,
                                 const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                                 const KeyframeRecord& query,
                                 const Eigen::Isometry3d& T_candidate_query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  loop.T_candidate_query = T_candidate_query;
  if (is_same_place(records, poses, query, config_.min_overlap, loop))
    loop.outcome = LoopOutcome::kAccepted;
  return loop;
}

Loop LoopVerifier::verify_lost(const std::deque<KeyframeRecord>& records,
                               const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                               const KeyframeRecord& query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  align(records[candidate], query, loop);
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
  check_lost(records, poses, query, std::min(config_.min_overlap, kMinLostOverlap), min_pairs,
             loop);
  const double turn = se3::angle(pose.inverse() * poses[loop.candidate] * loop.T_candidate_query);
  if (turn > kMaxLostTurn) loop.outcome = LoopOutcome::kNotRegistered;
  return loop;
}

Loop LoopVerifier::verify_lost_nearby(const std::deque<KeyframeRecord>& records,
                                      const std::vector<Eigen::Isometry3d>& poses,
                                      std::size_t candidate, const KeyframeRecord& query,
                                      const Eigen::Isometry3d& T_candidate_query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  loop.T_candidate_query = T_candidate_query;
  const bool has_texture = query.keypoints.size() >= static_cast<std::size_t>(config_.min_inliers);
  check_lost(records, poses, query, config_.min_overlap,
             has_texture ? kConfirmFactor * config_.min_inliers : 0.0, loop);
  if (loop.outcome != LoopOutcome::kContradiction) return loop;
  loop.inliers = pairs_at(records, poses, query, loop);
  if (loop.inliers >= kSureFactor * config_.min_inliers) loop.outcome = LoopOutcome::kAccepted;
  return loop;
}

/// Pairs of keypoints of the candidate's place and a frame that agree with the loop.
int LoopVerifier::pairs_at(const std::deque<KeyframeRecord>& records,
                           const std::vector<Eigen::Isometry3d>& poses, const KeyframeRecord& query,
                           const Loop& loop) const {
  const Eigen::Isometry3d pose = poses[loop.candidate] * loop.T_candidate_query;
  const auto [first, end] = neighbors(records, loop.candidate);
  const PlaceMatches matches = match_at_place(keypoints_at(records, poses, first, end, noise_),
                                              query.keypoints, pose, noise_);
  return static_cast<int>(inliers_of(matches.pairs, pose).size());
}

/// The checks of a lost frame at a pose: where geometry repeats, the keypoints must agree with the
/// registered pose, too. Similar places differ by what some of the views around show.
void LoopVerifier::check_lost(const std::deque<KeyframeRecord>& records,
                              const std::vector<Eigen::Isometry3d>& poses,
                              const KeyframeRecord& query, double min_overlap, double min_pairs,
                              Loop& loop) const {
  if (!is_same_place(records, poses, query, min_overlap, loop)) return;
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
double LoopVerifier::contradiction_around(const std::deque<KeyframeRecord>& records,
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

bool LoopVerifier::is_same_place(const std::deque<KeyframeRecord>& records,
                                 const std::vector<Eigen::Isometry3d>& poses,
                                 const KeyframeRecord& query, double min_overlap,
                                 Loop& loop) const {
  if (!register_features(records, poses, query, loop)) return false;
  if (!compare(records[loop.candidate], query, min_overlap, loop)) return false;
  loop.dissimilarity = dissimilarity_around(records, poses, loop.candidate, query.view,
                                            poses[loop.candidate] * loop.T_candidate_query);
  loop.outcome = LoopOutcome::kOtherTexture;
  return loop.dissimilarity <= config_.max_dissimilarity;
}

/// Dissimilarity of a view and those of the keyframes around one.
double LoopVerifier::dissimilarity_around(const std::deque<KeyframeRecord>& records,
                                          const std::vector<Eigen::Isometry3d>& poses,
                                          std::size_t keyframe, const KeyframeView& view,
                                          const Eigen::Isometry3d& pose) const {
  const auto [first, end] = neighbors(records, keyframe, kViewsAround);
  TextureComparison sum;
  for (std::size_t i = first; i < end; ++i) {
    sum += compare_textures(records[i].view, view, poses[i].inverse() * pose, noise_);
  }
  return sum.dissimilarity();
}

bool LoopVerifier::align(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const {
  if (a.is_scan() != b.is_scan()) return false;
  return b.is_scan() ? align_scans(a, b, loop) : align_keypoints(a.keypoints, b.keypoints, loop);
}

/// Relative pose by pairs of keypoints on the floor.
bool LoopVerifier::align_scans(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const {
  const std::vector<KeypointMatch> matches =
      match_keypoints(a.keypoints.descriptors, b.keypoints.descriptors);
  loop.outcome = LoopOutcome::kFewMatches;
  if (matches.size() < static_cast<std::size_t>(config_.min_scan_inliers)) return false;
  std::vector<Eigen::Vector2d> places_a;
  std::vector<Eigen::Vector2d> places_b;
  for (const KeypointMatch& match : matches) {
    places_a.push_back(a.keypoints.pixels[match.a].cast<double>());
    places_b.push_back(b.keypoints.pixels[match.b].cast<double>());
  }
  loop.outcome = LoopOutcome::kFewInliers;
  const auto alignment = align_on_floor(places_a, places_b, kMaxPlaceError, loop.query);
  if (!alignment) return false;
  loop.inliers = static_cast<int>(alignment->inliers.size());
  Eigen::Isometry3d T_floors = Eigen::Isometry3d::Identity();
  T_floors.linear().topLeftCorner<2, 2>() = alignment->T_a_b.linear();
  T_floors.translation().head<2>() = alignment->T_a_b.translation();
  loop.T_candidate_query = a.scan.T_sensor_floor * T_floors * b.scan.T_sensor_floor.inverse();
  if (loop.inliers < config_.min_scan_inliers) return false;
  loop.outcome = LoopOutcome::kNotSpread;
  return is_spread(places_a, alignment->inliers);
}

/// Relative pose by pairs of keypoints.
bool LoopVerifier::align_keypoints(const ImageKeypoints& a, const ImageKeypoints& b,
                                   Loop& loop) const {
  const std::vector<KeypointMatch> matches = match_keypoints(a.descriptors, b.descriptors);
  loop.outcome = LoopOutcome::kFewMatches;
  if (matches.size() < static_cast<std::size_t>(config_.min_inliers)) return false;
  PointPairs pairs;
  for (const KeypointMatch& match : matches) {
    pairs.a.push_back(a.points[match.a].cast<double>());
    pairs.b.push_back(b.points[match.b].cast<double>());
    pairs.sigma.push_back(std::hypot(keypoint_sigma(a.points[match.a], noise_),
                                     keypoint_sigma(b.points[match.b], noise_)));
  }
  loop.outcome = LoopOutcome::kFewInliers;
  const auto alignment = align_points(pairs, loop.query);
  if (!alignment) return false;
  loop.T_candidate_query = alignment->T_a_b;
  loop.inliers = static_cast<int>(alignment->inliers.size());
  if (loop.inliers < config_.min_inliers) return false;
  loop.outcome = LoopOutcome::kNotSpread;
  std::vector<Eigen::Vector2f> pixels_a;
  std::vector<Eigen::Vector2f> pixels_b;
  for (const std::size_t i : alignment->inliers) {
    pixels_a.push_back(a.pixels[matches[i].a]);
    pixels_b.push_back(b.pixels[matches[i].b]);
  }
  return is_spread(pixels_a) && is_spread(pixels_b);
}

/// Refines the pose as the odometry does, against the features around the candidate.
bool LoopVerifier::register_features(const std::deque<KeyframeRecord>& records,
                                     const std::vector<Eigen::Isometry3d>& poses,
                                     const KeyframeRecord& query, Loop& loop) const {
  loop.outcome = LoopOutcome::kNotRegistered;
  const FeatureCloud& features = query.features;
  LocalMaps maps(automatic_voxel_size(median_range(features)), kMaxVoxels);
  const Eigen::Isometry3d T_candidate_world = poses[loop.candidate].inverse();
  const auto [first, end] = neighbors(records, loop.candidate);
  for (std::size_t i = first; i < end; ++i) {
    maps.insert(records[i].features, T_candidate_world * poses[i],
                registration_.geometric.association);
  }
  const RegistrationResult result =
      register_frame(features, {maps, {}}, {loop.T_candidate_query}, registration_, noise_);
  const auto offered = static_cast<double>(features.edges.size() + features.planes.size());
  if (!result.T_world_sensor.matrix().allFinite()) return false;
  if (result.geometric.inliers() < kMinFit * offered) return false;
  const Eigen::Isometry3d change = loop.T_candidate_query.inverse() * result.T_world_sensor;
  if (change.translation().norm() > (query.is_scan() ? kMaxScanShift : kMaxShift) ||
      se3::angle(change) > kMaxTurn)
    return false;
  loop.T_candidate_query = result.T_world_sensor;
  loop.information = with_floor(result.information / kResidualsPerMeasurement);
  return true;
}

/// Overlap and free space of both views.
bool LoopVerifier::compare(const KeyframeRecord& a, const KeyframeRecord& b, double min_overlap,
                           Loop& loop) const {
  const auto agreement = [&](const KeyframeRecord& seen, const KeyframeRecord& other,
                             const Eigen::Isometry3d& T) {
    return seen.is_scan() ? compare_scans(seen.scan, other.scan, T)
                          : compare_views(seen.view, other.view, T, noise_);
  };
  const ViewAgreement of_b = agreement(a, b, loop.T_candidate_query);
  const ViewAgreement of_a = agreement(b, a, loop.T_candidate_query.inverse());
  loop.overlap = std::min(of_a.overlap, of_b.overlap);
  loop.contradiction = std::max(of_a.contradiction, of_b.contradiction);
  loop.outcome = LoopOutcome::kLittleOverlap;
  if (loop.overlap < min_overlap) return false;
  loop.outcome = LoopOutcome::kContradiction;
  return loop.contradiction <= config_.max_contradiction;
}

}  // namespace mms
