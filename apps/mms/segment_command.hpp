#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms segment`.
void add_segment_command(CLI::App& app);

}  // namespace mms
