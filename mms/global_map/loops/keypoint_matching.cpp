#include "mms/global_map/loops/keypoint_matching.hpp"

#include <cstddef>

namespace mms {
namespace {

/// [-]: largest distance of descriptors of one point. Source: between ORB-SLAM's thresholds 50 and
/// 100; geometry decides on the rest.
constexpr int kMaxDistance = 64;

/// [-]: largest ratio of the smallest distance to the next. Source: 0.8 of Lowe (IJCV 2004) for
/// images without depth; here geometry follows.
constexpr double kMaxRatio = 0.9;

/// The two smallest distances of a descriptor.
struct Nearest {
  int best = BinaryDescriptor::kBits + 1;
  int next = BinaryDescriptor::kBits + 1;
  std::uint32_t index = 0;

  void add(int distance, std::size_t other) {
    if (distance < best) {
      next = best;
      best = distance;
      index = static_cast<std::uint32_t>(other);
    } else if (distance < next) {
      next = distance;
    }
  }
};

}  // namespace

std::vector<KeypointMatch> match_keypoints(const std::vector<BinaryDescriptor>& a,
                                           const std::vector<BinaryDescriptor>& b) {
  std::vector<Nearest> of_a(a.size());
  std::vector<Nearest> of_b(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int distance = hamming_distance(a[i], b[j]);
      of_a[i].add(distance, j);
      of_b[j].add(distance, i);
    }
  }
  std::vector<KeypointMatch> matches;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Nearest& nearest = of_a[i];
    if (nearest.best > kMaxDistance || of_b[nearest.index].index != i) continue;
    if (nearest.best > kMaxRatio * nearest.next) continue;
    matches.push_back({static_cast<std::uint32_t>(i), nearest.index});
  }
  return matches;
}

}  // namespace mms
