#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/io/text/temporary_path.hpp"
#include "mms/server/scene/viewer_scene.hpp"

namespace mms {

/// Files of a run that can be downloaded: of a finished run the known files in its folder, of a
/// live one the present map and trajectory.
std::vector<std::string> download_names(const Scene& scene);

/// Path of a file in a finished run's folder; nullopt if the name is unknown or not a regular file.
std::optional<std::filesystem::path> find_download(const std::filesystem::path& folder,
                                                   std::string_view name);

/// Whether a live run provides a file of that name.
bool is_live_download(std::string_view name);

/// A file in a temporary folder of its own.
struct LiveDownload {
  TemporaryPath folder;  ///< of this file alone
  TemporaryPath file;    ///< in the folder
};

/// Writes the present state of a live run to a new file in a new temporary folder.
/// @throws FileError if it cannot be written.
std::unique_ptr<LiveDownload> write_live_download(Scene& scene, std::string_view name);

}  // namespace mms
