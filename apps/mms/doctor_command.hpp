#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms doctor`: what this machine and build can do, and whether the program works on it.
void add_doctor_command(CLI::App& app);

}  // namespace mms
