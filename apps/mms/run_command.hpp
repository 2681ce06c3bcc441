#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms run [DATA]`: the whole system over a recording, results in a folder.
void add_run_command(CLI::App& app);

}  // namespace mms
