#pragma once

#include <filesystem>
#include <optional>

#include "mms/core/calibration.hpp"

namespace mms {

/// The TUM benchmark's published color intrinsics for a folder with freiburg1 (or fr1), 2 or 3 in
/// its name; nullopt for other names.
std::optional<Calibration> tum_default_calibration(const std::filesystem::path& folder);

}  // namespace mms
