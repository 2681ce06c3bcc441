#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/global_map/places/binary_descriptor.hpp"

namespace mms {

/// Approximate search for similar binary descriptors: several binary trees, each of which divides
/// the descriptors by single bits, chosen from bits of its own. Incremental and deterministic,
/// without a vocabulary (as HBST: Schlegel and Grisetti, RA-L 2018). The cost of a search grows
/// with the depth of the trees only.
class DescriptorForest {
 public:
  DescriptorForest();

  /// Adds a descriptor; its id is the number of those added before.
  void insert(const BinaryDescriptor& descriptor);

  /// Appends the ids of the descriptors that share a leaf with `descriptor`, ascending and unique.
  void find(const BinaryDescriptor& descriptor, std::vector<std::uint32_t>& ids) const;

  const BinaryDescriptor& at(std::uint32_t id) const { return descriptors_[id]; }
  std::size_t size() const { return descriptors_.size(); }

 private:
  struct Node {
    std::uint32_t child = 0;         ///< of bit 0, that of bit 1 follows; 0 for a leaf
    std::uint16_t bit = 0;           ///< that divides
    std::vector<std::uint32_t> ids;  ///< of a leaf
  };
  struct Tree {
    std::vector<std::uint16_t> bits;  ///< to choose from
    std::vector<Node> nodes;          ///< the root first
  };

  const Node& leaf_of(const Tree& tree, const BinaryDescriptor& descriptor) const;
  void insert(Tree& tree, std::uint32_t id);
  bool divide(Tree& tree, std::uint32_t index) const;

  std::vector<Tree> trees_;
  std::vector<BinaryDescriptor> descriptors_;
};

}  // namespace mms
