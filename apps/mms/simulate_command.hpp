#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms simulate SCENE -o DIR`, which writes a simulated recording with its truth, and
/// `mms simulate training-set`.
void add_simulate_command(CLI::App& app);

}  // namespace mms
