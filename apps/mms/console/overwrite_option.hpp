#pragma once

#include <CLI/App.hpp>
#include <filesystem>

namespace mms {

/// Adds --overwrite for an output file.
void add_overwrite_flag(CLI::App& command, bool& overwrite);

/// To be called before the work whose result is the file. Devices are not refused.
/// @throws FileError if the file exists, unless `overwrite`.
void refuse_existing_file(const std::filesystem::path& file, bool overwrite);

}  // namespace mms
