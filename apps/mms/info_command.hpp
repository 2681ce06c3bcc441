#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms info DATA`: what a recording holds, and whether its frames can be read.
void add_info_command(CLI::App& app);

}  // namespace mms
