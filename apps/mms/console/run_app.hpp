#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Executes a command line. Faults are printed in one line on stderr.
/// @returns the exit code: 0, 1 for a fault of data or files, 2 for one of the command line, 130
/// for a command that was interrupted.
int run_app(CLI::App& app, int argc, char** argv);

}  // namespace mms
