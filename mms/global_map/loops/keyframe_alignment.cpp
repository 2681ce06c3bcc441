#include "mms/global_map/loops/keyframe_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>

#include "mms/geometry/principal_axes.hpp"
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

/// [m]: distance of the places of a pair of keypoints on the floor. Source: three pixels.
constexpr double kMaxPlaceError = 0.3;

/// [m]: least standard deviation of the places of inliers along their longer side. Source: initial
/// choice; a rack of pallets is shorter.
constexpr double kMinLength = 2.0;

/// [m]: the same along the shorter side. Source: initial choice; one row of posts is thinner.
constexpr double kMinWidth = 0.5;

bool is_spread(const std::vector<Eigen::Vector2d>& places, const std::vector<std::size_t>& chosen) {
  PointSums<double, 2> sums;
  for (const std::size_t i : chosen) sums.add(places[i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(sums.covariance());
  return axes.eigenvalues()(0) > kMinWidth * kMinWidth &&
         axes.eigenvalues()(1) > kMinLength * kMinLength;
}

}  // namespace

bool is_spread(const std::vector<Eigen::Vector2f>& pixels) {
  std::set<int> cells;
  for (const Eigen::Vector2f& pixel : pixels) {
    cells.insert(static_cast<int>(pixel.y() * kRows) * static_cast<int>(kColumns) +
                 static_cast<int>(pixel.x() * kColumns));
  }
  return cells.size() >= kMinCells;
}

bool KeyframeAligner::align(const KeyframeRecord& a, const KeyframeRecord& b, Loop& loop) const {
  if (a.is_scan() != b.is_scan()) return false;
  return b.is_scan() ? align_scans(a, b, loop) : align_keypoints(a.keypoints, b.keypoints, loop);
}

/// Relative pose by pairs of keypoints on the floor.
bool KeyframeAligner::align_scans(const KeyframeRecord& a, const KeyframeRecord& b,
                                  Loop& loop) const {
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
bool KeyframeAligner::align_keypoints(const ImageKeypoints& a, const ImageKeypoints& b,
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

}  // namespace mms
