#include "mms/geometry/voxels/voxel_downsampling.hpp"

#include <tsl/robin_map.h>

#include <cstddef>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

VoxelDownsampled voxel_downsample(std::span<const Eigen::Vector3f> points, float size) {
  const float inverse_size = 1.0F / size;
  VoxelDownsampled result;
  result.voxel.assign(points.size(), VoxelDownsampled::kNone);
  tsl::robin_map<VoxelKey, int, VoxelKeyHash> index(points.size() / 4);
  std::vector<Eigen::Vector3d> sums;
  std::vector<int> counts;
  VoxelKey last_key;  // neighbors in a ring mostly share a voxel
  int last = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const VoxelKey key = voxel_key(points[i], inverse_size);
    if (key != last_key || sums.empty()) {
      const auto [entry, is_new] = index.try_emplace(key, static_cast<int>(sums.size()));
      if (is_new) {
        sums.emplace_back(Eigen::Vector3d::Zero());
        counts.push_back(0);
      }
      last_key = key;
      last = entry->second;
    }
    const auto voxel = static_cast<std::size_t>(last);
    sums[voxel] += points[i].cast<double>();
    ++counts[voxel];
    result.voxel[i] = last;
  }
  result.points.reserve(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    result.points.emplace_back((sums[v] / counts[v]).cast<float>());
  }
  return result;
}

}  // namespace mms
