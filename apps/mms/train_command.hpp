#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms train`.
void add_train_command(CLI::App& app);

}  // namespace mms
