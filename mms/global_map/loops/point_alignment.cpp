#include "mms/global_map/loops/point_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mms/core/random_stream.hpp"
#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

/// [-]: samples of three pairs, at least. Source: finds three inliers among 20 % with a probability
/// of 0.98.
constexpr double kMinSamples = 500.0;

/// [-]: the same, at most. Source: as `kMinSamples`, among 8 %; 99 of 100 cost three distances.
constexpr double kMaxSamples = 8000.0;

/// [-]: samples that have three inliers, on average. Source: with four, one has them with the
/// probability of `kMinSamples`.
constexpr double kHits = 4.0;

/// [-]: standard deviations up to which a pair is an inlier. Source: three-sigma rule.
constexpr double kInlierSigmas = 3.0;

/// [m]: least side of a sampled triangle. Source: shorter ones give no rotation with noise of 1 cm.
constexpr double kMinSide = 0.2;

/// [-]: rounds of least squares. Source: the inliers are those of the transform after two.
constexpr int kRounds = 3;

/// [-]: pairs that agree, at least. Source: one more than three, which always have a transform.
constexpr std::size_t kMinInliers = 4;

using Indices = std::vector<std::size_t>;

/// Least squares, each pair weighted by 1 / sigma^2.
Eigen::Isometry3d fit(const PointPairs& pairs, const Indices& indices) {
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (const std::size_t i : indices) {
    const double weight = 1.0 / (pairs.sigma[i] * pairs.sigma[i]);
    mean_a += weight * pairs.a[i];
    mean_b += weight * pairs.b[i];
    sum += weight;
  }
  mean_a /= sum;
  mean_b /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::size_t i : indices) {
    const double weight = 1.0 / (pairs.sigma[i] * pairs.sigma[i]);
    covariance += weight * (pairs.a[i] - mean_a) * (pairs.b[i] - mean_b).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T.translation() = mean_a - T.linear() * mean_b;
  return se3::normalized(T);
}

/// Whether three pairs can be the same triangle, and a large enough one.
bool is_triangle(const PointPairs& pairs, const std::array<std::size_t, 3>& sample) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = sample[k];
    const std::size_t j = sample[(k + 1) % 3];
    const double side_a = (pairs.a[i] - pairs.a[j]).norm();
    const double side_b = (pairs.b[i] - pairs.b[j]).norm();
    if (side_a < kMinSide) return false;
    if (std::abs(side_a - side_b) > kInlierSigmas * (pairs.sigma[i] + pairs.sigma[j])) return false;
  }
  return true;
}

/// Samples of three pairs that are enough, if the inliers so far are all.
int samples_for(std::size_t inliers, std::size_t pairs) {
  const double share = static_cast<double>(inliers) / static_cast<double>(pairs);
  const double three = share * share * share;  // probability that all three are inliers
  if (three * kMaxSamples <= kHits) return static_cast<int>(kMaxSamples);
  return static_cast<int>(std::max(kHits / three, kMinSamples));
}

}  // namespace

std::vector<std::size_t> inliers_of(const PointPairs& pairs, const Eigen::Isometry3d& T_a_b) {
  Indices inliers;
  for (std::size_t i = 0; i < pairs.a.size(); ++i) {
    const double distance = (pairs.a[i] - T_a_b * pairs.b[i]).norm();
    if (distance < kInlierSigmas * pairs.sigma[i]) inliers.push_back(i);
  }
  return inliers;
}

std::optional<PointAlignment> align_points(const PointPairs& pairs, std::uint64_t seed) {
  if (pairs.a.size() < kMinInliers) return std::nullopt;
  RandomStream random(seed);
  PointAlignment best;
  for (int s = 0; s < samples_for(best.inliers.size(), pairs.a.size()); ++s) {
    const std::array<std::size_t, 3> sample = {
        random.below(pairs.a.size()), random.below(pairs.a.size()), random.below(pairs.a.size())};
    if (!is_triangle(pairs, sample)) continue;
    const Eigen::Isometry3d T = fit(pairs, {sample.begin(), sample.end()});
    Indices inliers = inliers_of(pairs, T);
    if (inliers.size() > best.inliers.size()) best = {T, std::move(inliers)};
  }
  if (best.inliers.size() < kMinInliers) return std::nullopt;
  return refine_alignment(pairs, best.T_a_b);
}

PointAlignment refine_alignment(const PointPairs& pairs, const Eigen::Isometry3d& T_a_b) {
  PointAlignment best{T_a_b, inliers_of(pairs, T_a_b)};
  for (int round = 0; round < kRounds && best.inliers.size() >= kMinInliers; ++round) {
    const Eigen::Isometry3d T = fit(pairs, best.inliers);
    Indices inliers = inliers_of(pairs, T);
    if (inliers.size() < best.inliers.size()) break;
    best = {T, std::move(inliers)};
  }
  return best;
}

}  // namespace mms
