#include "mms/global_map/loops/floor_alignment.hpp"

#include <cmath>
#include <utility>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

/// [-]: samples of two pairs. Source: finds two inliers among 10 % with a probability of 0.99994.
constexpr int kFloorSamples = 1000;

/// [-]: least distance of the two places of a sample, over the tolerance. Source: initial choice;
/// the heading of a shorter one is off by more than 0.1 rad.
constexpr double kMinBase = 10.0;

/// [-]: rounds of least squares. Source: the inliers are those of the transform after two.
constexpr int kFloorRounds = 3;

/// [-]: pairs that agree, at least. Source: one more than two, which always have a transform.
constexpr std::size_t kMinFloorInliers = 3;

using Places = std::vector<Eigen::Vector2d>;
using Indices = std::vector<std::size_t>;

Eigen::Isometry2d fit_places(const Places& a, const Places& b, const Indices& indices) {
  Eigen::Vector2d mean_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_b = Eigen::Vector2d::Zero();
  for (const std::size_t i : indices) {
    mean_a += a[i];
    mean_b += b[i];
  }
  mean_a /= static_cast<double>(indices.size());
  mean_b /= static_cast<double>(indices.size());
  double along = 0.0;
  double across = 0.0;
  for (const std::size_t i : indices) {
    const Eigen::Vector2d p = a[i] - mean_a;
    const Eigen::Vector2d q = b[i] - mean_b;
    along += p.dot(q);
    across += q.x() * p.y() - q.y() * p.x();
  }
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(std::atan2(across, along)).toRotationMatrix();
  T.translation() = mean_a - T.linear() * mean_b;
  return T;
}

Indices places_within(const Places& a, const Places& b, const Eigen::Isometry2d& T_a_b,
                      double tolerance) {
  Indices inliers;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] - T_a_b * b[i]).norm() < tolerance) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace

std::optional<FloorAlignment> align_on_floor(const Places& a, const Places& b, double tolerance,
                                             std::uint64_t seed) {
  if (a.size() < kMinFloorInliers) return std::nullopt;
  RandomStream random(seed);
  FloorAlignment best;
  for (int s = 0; s < kFloorSamples; ++s) {
    const std::size_t i = random.below(a.size());
    const std::size_t j = random.below(a.size());
    const double base = (a[i] - a[j]).norm();
    if (base < kMinBase * tolerance) continue;
    if (std::abs(base - (b[i] - b[j]).norm()) > 2.0 * tolerance) continue;
    const Eigen::Isometry2d T = fit_places(a, b, {i, j});
    Indices inliers = places_within(a, b, T, tolerance);
    if (inliers.size() > best.inliers.size()) best = {T, std::move(inliers)};
  }
  if (best.inliers.size() < kMinFloorInliers) return std::nullopt;
  for (int round = 0; round < kFloorRounds; ++round) {
    const Eigen::Isometry2d T = fit_places(a, b, best.inliers);
    Indices inliers = places_within(a, b, T, tolerance);
    if (inliers.size() < kMinFloorInliers) break;
    best = {T, std::move(inliers)};
  }
  return best;
}

}  // namespace mms
