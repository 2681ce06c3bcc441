#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms import`.
void add_import_command(CLI::App& app);

}  // namespace mms
