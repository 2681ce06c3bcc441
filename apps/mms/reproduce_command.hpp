#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms reproduce`: the paper's tables and figures by one command.
void add_reproduce_command(CLI::App& app);

}  // namespace mms
