#include "mms/global_map/places/place_recognizer.hpp"

#include <algorithm>
#include <cmath>

#include "mms/global_map/places/best_apart.hpp"

namespace mms {
namespace {

/// [-]: largest distance of descriptors of one point. Source: ORB-SLAM's lower threshold
/// (Mur-Artal et al., T-RO 2015), of 256 bits.
constexpr int kMaxDistance = 50;

/// [-]: least score of a candidate. Source: initial choice, about three rare descriptors;
/// geometry decides later.
constexpr double kMinScore = 10.0;

/// [-]: keyframes to a better candidate up to which one shows the same place. Source: about 1 m.
constexpr std::size_t kGroup = 4;

}  // namespace

void PlaceRecognizer::add(const std::vector<BinaryDescriptor>& descriptors) {
  for (const BinaryDescriptor& descriptor : descriptors) {
    forest_.insert(descriptor);
    keyframe_of_.push_back(static_cast<std::uint32_t>(keyframes_));
  }
  ++keyframes_;
}

std::vector<PlaceCandidate> PlaceRecognizer::find(const std::vector<BinaryDescriptor>& descriptors,
                                                  std::size_t end, std::size_t max_count,
                                                  const IsUsable& is_usable) const {
  std::vector<double> scores(std::min(end, keyframes_));
  std::vector<std::uint32_t> ids;
  std::vector<std::uint32_t> found;
  for (const BinaryDescriptor& descriptor : descriptors) {
    ids.clear();
    found.clear();
    forest_.find(descriptor, ids);
    for (const std::uint32_t id : ids) {
      const std::uint32_t keyframe = keyframe_of_[id];
      if (keyframe >= scores.size() || (!found.empty() && found.back() == keyframe)) continue;
      if (hamming_distance(forest_.at(id), descriptor) <= kMaxDistance) found.push_back(keyframe);
    }
    if (found.empty()) continue;
    const double weight =
        std::log(1.0 + static_cast<double>(keyframes_) / static_cast<double>(found.size()));
    for (const std::uint32_t keyframe : found) scores[keyframe] += weight;
  }
  std::vector<PlaceCandidate> all;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] >= kMinScore && is_usable(i)) all.push_back({i, scores[i]});
  }
  std::stable_sort(all.begin(), all.end(), [](const PlaceCandidate& a, const PlaceCandidate& b) {
    return a.score > b.score;
  });
  return best_apart(all, max_count, kGroup, &PlaceCandidate::keyframe);
}

}  // namespace mms
