#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/server/scene/scene.hpp"

namespace mms {

/// The files of a run that may be fetched now: of a finished run the known ones among those in its
/// folder; of a live one the map and the trajectory as they are.
std::vector<std::string> download_names(const Scene& scene);

/// The file of that name in a finished run's folder; nothing where the name is not one of the
/// known ones, or the file is no regular one.
std::optional<std::filesystem::path> find_download(const std::filesystem::path& folder,
                                                   std::string_view name);

/// Whether a live run gives a file of that name.
bool is_live_download(std::string_view name);

/// Writes what there is of a live run into a new file in a temporary folder of its own; the caller
/// removes both. @throws FileError when it cannot be written.
std::filesystem::path write_live_download(Scene& scene, std::string_view name);

}  // namespace mms
