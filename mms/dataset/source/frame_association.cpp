#include "mms/dataset/source/frame_association.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace mms {
namespace {

struct Candidate {
  Duration difference{};
  Timestamp stamp;
  std::size_t first = 0;
  std::size_t second = 0;

  auto key() const { return std::tuple(difference, stamp, first, second); }
};

std::vector<std::size_t> order_of(std::span<const Timestamp> stamps) {
  std::vector<std::size_t> order(stamps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
  return order;
}

/// Indices of equal stamps, in their order.
struct EqualStamps {
  Timestamp stamp;
  std::vector<std::size_t> indices;
};

std::vector<EqualStamps> by_stamp(std::span<const Timestamp> stamps) {
  std::vector<EqualStamps> groups;
  for (const std::size_t i : order_of(stamps)) {
    if (groups.empty() || groups.back().stamp != stamps[i]) groups.push_back({stamps[i], {}});
    groups.back().indices.push_back(i);
  }
  return groups;
}

/// Of equal stamps, those of a sensor whose clock stands still, the k-th ones are pairs: all pairs
/// would be too many.
std::vector<Candidate> candidates_of(std::span<const Timestamp> first,
                                     std::span<const Timestamp> second, Duration max_difference) {
  const std::vector<EqualStamps> others = by_stamp(second);
  std::vector<Candidate> candidates;
  for (const EqualStamps& group : by_stamp(first)) {
    const auto begin =
        std::lower_bound(others.begin(), others.end(), group.stamp - max_difference,
                         [](const EqualStamps& o, Timestamp stamp) { return o.stamp < stamp; });
    for (auto o = begin; o != others.end() && o->stamp - group.stamp <= max_difference; ++o) {
      const Duration difference = std::chrono::abs(o->stamp - group.stamp);
      const std::size_t count = std::min(group.indices.size(), o->indices.size());
      for (std::size_t k = 0; k < count; ++k) {
        candidates.push_back({difference, group.stamp, group.indices[k], o->indices[k]});
      }
    }
  }
  return candidates;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associate(std::span<const Timestamp> first,
                                                           std::span<const Timestamp> second,
                                                           Duration max_difference) {
  std::vector<Candidate> candidates = candidates_of(first, second, max_difference);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.key() < b.key(); });
  std::vector<bool> first_used(first.size());
  std::vector<bool> second_used(second.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Candidate& candidate : candidates) {
    if (first_used[candidate.first] || second_used[candidate.second]) continue;
    first_used[candidate.first] = true;
    second_used[candidate.second] = true;
    pairs.emplace_back(candidate.first, candidate.second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace mms
