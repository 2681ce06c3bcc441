#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace mms {

/// Of candidates, best first, those that are more than `group` keyframes from every better one.
/// @param max_count    of them
/// @param keyframe_of  member of a candidate: the number of its keyframe
template <class Candidate, class KeyframeOf>
std::vector<Candidate> best_apart(const std::vector<Candidate>& candidates, std::size_t max_count,
                                  std::size_t group, KeyframeOf keyframe_of) {
  std::vector<Candidate> best;
  for (const Candidate& candidate : candidates) {
    if (best.size() == max_count) break;
    const std::size_t keyframe = std::invoke(keyframe_of, candidate);
    const bool is_near = std::any_of(best.begin(), best.end(), [&](const Candidate& better) {
      const std::size_t other = std::invoke(keyframe_of, better);
      return keyframe <= other + group && other <= keyframe + group;
    });
    if (!is_near) best.push_back(candidate);
  }
  return best;
}

}  // namespace mms
