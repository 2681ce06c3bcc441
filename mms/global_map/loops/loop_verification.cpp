#include "mms/global_map/loops/loop_verification.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/keyframes/view_texture.hpp"

namespace mms {
namespace {

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

/// [-]: correlated residuals of a view that count as one measurement. Source: initial choice.
constexpr double kResidualsPerMeasurement = 30.0;

/// [m]: standard deviation of a loop beside the registration's own, which assumes independent
/// residuals. Source: errors of 93 loops of `warehouse_loop`: median 0.4 cm, 95 % below 1 cm.
constexpr double kTranslationFloor = 0.01;

/// [rad]: the same of the rotation. Source: median 0.03 degrees, 95 % below 0.1 degrees.
constexpr double kRotationFloor = 0.1 * std::numbers::pi / 180.0;

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
    : config_(config), aligner_(config, noise), registration_(registration), noise_(noise) {}

Loop LoopVerifier::verify(const std::deque<KeyframeRecord>& records,
                          const std::vector<Eigen::Isometry3d>& poses, std::size_t candidate,
                          const KeyframeRecord& query) const {
  Loop loop;
  loop.candidate = candidate;
  loop.query = records.size();
  if (aligner_.align(records[candidate], query, loop) &&
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
