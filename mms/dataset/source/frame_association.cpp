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

/// The first ones of equal stamps: those of a sensor whose clock stands still would all be pairs.
std::vector<std::size_t> distinct(std::span<const Timestamp> stamps) {
  std::vector<std::size_t> order = order_of(stamps);
  const auto are_equal = [&](std::size_t a, std::size_t b) { return stamps[a] == stamps[b]; };
  order.erase(std::unique(order.begin(), order.end(), are_equal), order.end());
  return order;
}

std::vector<Candidate> candidates_of(std::span<const Timestamp> first,
                                     std::span<const Timestamp> second, Duration max_difference) {
  const std::vector<std::size_t> order = distinct(second);
  std::vector<Candidate> candidates;
  for (const std::size_t i : distinct(first)) {
    const auto begin =
        std::lower_bound(order.begin(), order.end(), first[i] + -max_difference,
                         [&](std::size_t j, Timestamp stamp) { return second[j] < stamp; });
    for (auto j = begin; j != order.end() && second[*j] - first[i] <= max_difference; ++j) {
      const Duration difference = std::chrono::abs(second[*j] - first[i]);
      candidates.push_back({difference, first[i], i, *j});
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
