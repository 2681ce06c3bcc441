#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms convert`: files in other formats, and the files of a run that was killed.
void add_convert_command(CLI::App& app);

}  // namespace mms
