#include "mms/io/results/octomap_io.hpp"

#include <octomap/OcTree.h>

#include <cstdint>
#include <optional>
#include <ostream>
#include <vector>

#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

std::optional<octomap::OcTreeKey> octomap_key(const VoxelKey& key) {
  constexpr std::int32_t kCenter = 32768;
  const auto fits = [](std::int32_t value) { return value >= -kCenter && value < kCenter; };
  if (!fits(key.x) || !fits(key.y) || !fits(key.z)) return std::nullopt;
  const auto part = [](std::int32_t value) { return static_cast<std::uint16_t>(value + kCenter); };
  return octomap::OcTreeKey(part(key.x), part(key.y), part(key.z));
}

/// Replaces the library's writer, which also prints to the terminal.
void write_header(const octomap::OcTree& tree, std::ostream& stream) {
  stream << "# Octomap OcTree binary file\n# free and occupied space, z up\nid "
         << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
         << format_number(tree.getResolution()) << "\ndata\n";
}

/// Sets the voxels to `log_odds`; returns the number of voxels outside the tree.
std::size_t set_all(const std::vector<VoxelKey>& keys, float log_odds, octomap::OcTree& tree) {
  std::size_t left_out = 0;
  for (const VoxelKey& key : keys) {
    const std::optional<octomap::OcTreeKey> place = octomap_key(key);
    // Lazy: the inner nodes are computed once, after all leaves.
    if (place) tree.setNodeValue(*place, log_odds, true);
    left_out += !place;
  }
  return left_out;
}

}  // namespace

std::size_t write_octomap(const std::filesystem::path& path, const OccupancyVoxels& voxels) {
  octomap::OcTree tree(voxels.voxel_size);
  std::size_t left_out = set_all(voxels.free, tree.getClampingThresMinLog(), tree);
  left_out += set_all(voxels.occupied, tree.getClampingThresMaxLog(), tree);
  tree.updateInnerOccupancy();
  tree.toMaxLikelihood();
  tree.prune();
  AtomicFile file(path);
  write_header(tree, file.stream());
  tree.writeBinaryData(file.stream());
  file.commit();
  return left_out;
}

}  // namespace mms
