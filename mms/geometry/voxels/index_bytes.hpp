#pragma once

#include <tsl/robin_map.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "mms/geometry/voxels/voxel_key.hpp"

namespace mms {

/// Bytes of the buckets of an index of voxels or blocks.
inline std::size_t index_bytes(const tsl::robin_map<VoxelKey, std::uint32_t, VoxelKeyHash>& index) {
  using Entry = std::pair<VoxelKey, std::uint32_t>;
  // [-]: bytes of a bucket. Source: robin_map stores a distance and a hash of 4 bytes each.
  constexpr std::size_t kBucketSize = sizeof(Entry) + 8;
  return index.bucket_count() * kBucketSize;
}

}  // namespace mms
