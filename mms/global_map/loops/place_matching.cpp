#include "mms/global_map/loops/place_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace mms {
namespace {

/// [m]: error of a keypoint's position beside the depth noise, as a share of its distance.
/// Source: two pixels at a focal length of 500 px.
constexpr double kRelativeError = 0.004;

/// [m]: least error of a keypoint's position. Source: views from other directions select other
/// points of one corner.
constexpr double kMinError = 0.01;

/// [-]: largest distance of descriptors of one point whose position is known. Source: in 700 views
/// of two warehouses, right places had 55 pairs up to 40 in the median, wrong ones 10.
constexpr int kMaxBits = 40;

/// [-]: standard deviations of the distance of a pair, at most. Source: three-sigma rule.
constexpr double kMaxSigmas = 3.0;

struct PossiblePair {
  int bits = 0;
  std::size_t known = 0;
  std::size_t seen = 0;
  double sigma = 0.0;
};

}  // namespace

double keypoint_sigma(const Eigen::Vector3f& point, const DepthNoise& noise) {
  const double z = point.z();
  return std::hypot(noise.sigma(z), kMinError + kRelativeError * z);
}

PlacedKeypoints keypoints_at(const std::deque<KeyframeRecord>& records,
                             const std::vector<Eigen::Isometry3d>& poses, std::size_t first,
                             std::size_t end, const DepthNoise& noise) {
  PlacedKeypoints result;
  for (std::size_t k = first; k < end; ++k) {
    const ImageKeypoints& keypoints = records[k].keypoints;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      result.descriptors.push_back(keypoints.descriptors[i]);
      result.points.emplace_back(poses[k] * keypoints.points[i].cast<double>());
      result.sigma.push_back(keypoint_sigma(keypoints.points[i], noise));
    }
  }
  return result;
}

PlaceMatches match_at_place(const PlacedKeypoints& place, const ImageKeypoints& frame,
                            const Eigen::Isometry3d& T_place_frame, const DepthNoise& noise) {
  const std::size_t count = frame.size();
  std::vector<Eigen::Vector3d> expected(count);
  std::vector<double> sigma(count);
  for (std::size_t i = 0; i < count; ++i) {
    expected[i] = T_place_frame * frame.points[i].cast<double>();
    sigma[i] = keypoint_sigma(frame.points[i], noise);
  }
  // By x, so that each keypoint of the place is compared with few.
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(expected[a].x(), a) < std::tie(expected[b].x(), b);
  });
  const double largest = count > 0 ? *std::max_element(sigma.begin(), sigma.end()) : 0.0;
  std::vector<PossiblePair> possible;
  for (std::size_t k = 0; k < place.points.size(); ++k) {
    const Eigen::Vector3d& known = place.points[k];
    const double radius = kMaxSigmas * std::hypot(place.sigma[k], largest);
    auto next = std::partition_point(order.begin(), order.end(), [&](std::size_t i) {
      return expected[i].x() < known.x() - radius;
    });
    for (; next != order.end() && expected[*next].x() <= known.x() + radius; ++next) {
      const double pair_sigma = std::hypot(place.sigma[k], sigma[*next]);
      if ((known - expected[*next]).norm() > kMaxSigmas * pair_sigma) continue;
      const int bits = hamming_distance(place.descriptors[k], frame.descriptors[*next]);
      if (bits <= kMaxBits) possible.push_back({bits, k, *next, pair_sigma});
    }
  }
  std::sort(possible.begin(), possible.end(), [](const PossiblePair& a, const PossiblePair& b) {
    return std::tie(a.bits, a.seen, a.known) < std::tie(b.bits, b.seen, b.known);
  });
  PlaceMatches matches;
  std::vector<bool> is_used(count);
  std::vector<bool> is_known_used(place.points.size());
  for (const PossiblePair& pair : possible) {
    if (is_used[pair.seen] || is_known_used[pair.known]) continue;
    is_used[pair.seen] = is_known_used[pair.known] = true;
    matches.pairs.a.push_back(place.points[pair.known]);
    matches.pairs.b.push_back(frame.points[pair.seen].cast<double>());
    matches.pairs.sigma.push_back(pair.sigma);
    matches.frames.push_back(pair.seen);
  }
  return matches;
}

}  // namespace mms
