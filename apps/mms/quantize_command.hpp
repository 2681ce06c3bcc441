#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms quantize`.
void add_quantize_command(CLI::App& app);

}  // namespace mms
