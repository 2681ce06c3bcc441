#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace mms {

/// Disjoint sets of 0 ... count - 1 (below 2^32). The representative of a set is its smallest
/// element, so the result does not depend on the order of unions.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  /// Representative of the set of `i`.
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  /// Joins the sets of `a` and `b`; returns the representative of the union.
  std::size_t unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a < b) std::swap(a, b);
    parent_[a] = static_cast<std::uint32_t>(b);
    return b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace mms
