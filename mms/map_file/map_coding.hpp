#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mms/global_map/keyframes/keyframe_record.hpp"
#include "mms/map_file/map_session.hpp"
#include "mms/mapping/static_map/map_cloud.hpp"

namespace mms {

// Large values of a map file: compressed by zstd with its checksum, see docs/map_file.md.

/// Keypoints, features and view of a keyframe; its other members are columns.
std::string encode_keyframe(const KeyframeRecord& keyframe);

/// Sets what `encode_keyframe` wrote.
/// @throws DataError at `where` if the bytes are damaged
void decode_keyframe(std::string_view bytes, const std::string& where, KeyframeRecord& keyframe);

/// Some points of a session's static map, in a spatial order: positions to 1/32 of a voxel, normals
/// to about 0.5 degrees, stamps to 10 ms.
/// @param voxel_size  [m]
/// @param indices     of the points
std::string encode_surfaces(const StampedMap& surfaces, double voxel_size,
                            std::vector<std::uint32_t> indices);

/// Appends the points that `encode_surfaces` wrote.
/// @throws DataError at `where` if the bytes are damaged; then nothing is appended
void decode_surfaces(std::string_view bytes, const std::string& where, StampedMap& surfaces);

}  // namespace mms
