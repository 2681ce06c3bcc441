#pragma once

#include <string>

#include "mms/geometry/voxels/map_changes.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms {

/// Appends a map's changes as a journal keeps them: 13 bytes a voxel, 18 a block.
void append_map(std::string& bytes, const MapChanges& changes);

/// Takes them off again. @throws DataError when bytes are missing or a value is out of range.
MapChanges take_map(ByteReader& bytes);

/// Side of a voxel [m]. @throws DataError when it is none.
double take_voxel_size(ByteReader& bytes);

}  // namespace mms
