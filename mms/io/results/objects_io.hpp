#pragma once

#include <filesystem>
#include <string>

#include "mms/core/object_box.hpp"

namespace mms {

/// objects.json, a run's tracked objects: {"tracks": [{"id", "class", "history": [{"stamp",
/// "position" [m] and "quaternion" (x y z w) of the box's middle in the world frame, "size" [m],
/// "velocity" [m/s], "moving", "score"}]}]}, by id. The class is that of the last frame.
std::string objects_json(const ObjectHistory& history);

/// @throws FileError when it cannot be read, DataError when it is no such file.
ObjectHistory read_objects(const std::filesystem::path& path);

/// Reads objects_truth.json of a simulated recording. An object's `visible` is the share that
/// neither the image's border nor another thing hides.
/// @throws FileError when it cannot be read, DataError when it is no such file.
ObjectHistory read_objects_truth(const std::filesystem::path& path);

}  // namespace mms
