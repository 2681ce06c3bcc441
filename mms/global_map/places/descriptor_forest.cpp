#include "mms/global_map/places/descriptor_forest.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "mms/core/random_stream.hpp"

namespace mms {
namespace {

/// [-]: number of trees. Source: descriptors of one point that differ in 30 of 256 bits share the
/// leaf of a tree of depth 14 with a probability of 0.17, and one of four such leaves with 0.53.
constexpr std::size_t kTrees = 4;

/// [-]: bits that each tree may divide by. Source: a quarter, so that trees share none.
constexpr std::size_t kBitsPerTree = BinaryDescriptor::kBits / kTrees;

/// [-]: descriptors in a leaf from which on it is divided. Source: 4 leaves cost about 10 us.
constexpr std::size_t kMaxLeaf = 64;

/// [-]: least share of the smaller part of a division. Source: initial choice; a leaf that no bit
/// divides holds copies of one descriptor, as repeated structures have, which identify no place.
constexpr double kMinPart = 0.1;

}  // namespace

DescriptorForest::DescriptorForest() : trees_(kTrees) {
  std::vector<std::uint16_t> bits(BinaryDescriptor::kBits);
  std::iota(bits.begin(), bits.end(), std::uint16_t{0});
  RandomStream random(1);
  for (std::size_t i = bits.size(); i > 1; --i) std::swap(bits[i - 1], bits[random.below(i)]);
  for (std::size_t t = 0; t < kTrees; ++t) {
    const auto first = bits.begin() + static_cast<std::ptrdiff_t>(t * kBitsPerTree);
    trees_[t].bits.assign(first, first + static_cast<std::ptrdiff_t>(kBitsPerTree));
    trees_[t].nodes.emplace_back();
  }
}

void DescriptorForest::insert(const BinaryDescriptor& descriptor) {
  const auto id = static_cast<std::uint32_t>(descriptors_.size());
  descriptors_.push_back(descriptor);
  for (Tree& tree : trees_) insert(tree, id);
}

void DescriptorForest::find(const BinaryDescriptor& descriptor,
                            std::vector<std::uint32_t>& ids) const {
  const auto first = static_cast<std::ptrdiff_t>(ids.size());
  for (const Tree& tree : trees_) {
    const std::vector<std::uint32_t>& leaf = leaf_of(tree, descriptor).ids;
    ids.insert(ids.end(), leaf.begin(), leaf.end());
  }
  std::sort(ids.begin() + first, ids.end());
  ids.erase(std::unique(ids.begin() + first, ids.end()), ids.end());
}

const DescriptorForest::Node& DescriptorForest::leaf_of(const Tree& tree,
                                                        const BinaryDescriptor& descriptor) const {
  std::uint32_t index = 0;
  while (tree.nodes[index].child != 0) {
    const Node& node = tree.nodes[index];
    index = node.child + (descriptor.bit(node.bit) ? 1U : 0U);
  }
  return tree.nodes[index];
}

void DescriptorForest::insert(Tree& tree, std::uint32_t id) {
  const Node& leaf = leaf_of(tree, descriptors_[id]);
  const auto index = static_cast<std::uint32_t>(&leaf - tree.nodes.data());
  if (leaf.ids.size() >= kMaxLeaf) {
    if (!divide(tree, index)) return;
    insert(tree, id);
    return;
  }
  tree.nodes[index].ids.push_back(id);
}

/// Divides a leaf by the bit that divides it most evenly. @returns false where none does
bool DescriptorForest::divide(Tree& tree, std::uint32_t index) const {
  const std::vector<std::uint32_t> ids = tree.nodes[index].ids;
  const auto ones = [&](std::uint16_t bit) {
    return std::count_if(ids.begin(), ids.end(),
                         [&](std::uint32_t id) { return descriptors_[id].bit(bit); });
  };
  const auto half = static_cast<std::ptrdiff_t>(ids.size() / 2);
  std::uint16_t best = 0;
  std::ptrdiff_t best_error = half + 1;
  for (const std::uint16_t bit : tree.bits) {
    const std::ptrdiff_t error = std::abs(ones(bit) - half);
    if (error < best_error) {
      best = bit;
      best_error = error;
    }
  }
  const double smaller_part = static_cast<double>(half - best_error);
  if (smaller_part < kMinPart * static_cast<double>(ids.size())) return false;
  const auto child = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.resize(tree.nodes.size() + 2);
  Node& node = tree.nodes[index];
  node.child = child;
  node.bit = best;
  node.ids = {};
  for (const std::uint32_t id : ids) {
    tree.nodes[child + (descriptors_[id].bit(best) ? 1U : 0U)].ids.push_back(id);
  }
  return true;
}

}  // namespace mms
