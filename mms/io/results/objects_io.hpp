#pragma once

#include <filesystem>
#include <string>

#include "mms/core/object_box.hpp"

namespace mms {

/// objects.json, the tracked objects of a run: {"tracks": [{"id", "class", "history": [{"stamp",
/// "position" [m] and "quaternion" (x y z w) of the box's center in the world frame, "size" [m],
/// "velocity" [m/s], "moving", "score"}]}]}, sorted by id. The class is that of the last frame.
std::string objects_json(const ObjectHistory& history);

/// @throws FileError if it cannot be read; DataError if the content is invalid.
ObjectHistory read_objects(const std::filesystem::path& path);

/// Reads objects_truth.json of a simulated recording. `visible` of an object is the share that
/// neither the image boundary nor an occluder hides.
/// @throws FileError if it cannot be read; DataError if the content is invalid.
ObjectHistory read_objects_truth(const std::filesystem::path& path);

}  // namespace mms
