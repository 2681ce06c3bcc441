#pragma once

#include <string>

#include "mms/geometry/voxels/map_changes.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms {

/// Appends the changes of a map: 13 bytes per voxel, 18 per block.
void append_map(std::string& bytes, const MapChanges& changes);

/// Inverse of `append_map`.
/// @throws DataError if bytes are missing or a value is out of range.
MapChanges take_map(ByteReader& bytes);

/// Side of a voxel [m].
/// @throws DataError if it is out of range.
double take_voxel_size(ByteReader& bytes);

}  // namespace mms
