#pragma once

#include <filesystem>
#include <memory>

#include "mms/server/scene/scene.hpp"

namespace mms {

/// A finished run to look at, from its folder: what mms run wrote, or the journal of one that was
/// killed.
/// @throws FileError, DataError when it is no such folder or a file in it cannot be read.
std::shared_ptr<Scene> open_recorded_scene(const std::filesystem::path& folder);

}  // namespace mms
