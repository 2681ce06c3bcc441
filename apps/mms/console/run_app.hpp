#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Obeys a command line. Whatever goes wrong is said in one line on stderr.
/// @returns the exit code: 0, 1 for a fault of the user's data or files, 2 for one of the command
/// line.
int run_app(CLI::App& app, int argc, char** argv);

}  // namespace mms
