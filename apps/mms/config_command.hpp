#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms config dump` and `mms config check FILE`.
void add_config_command(CLI::App& app);

}  // namespace mms
