#pragma once

#include <CLI/App.hpp>

namespace mms {

/// Adds `mms eval trajectory|drift|map|residue`. Running one prints a table, or with --json one
/// object with the contract's keys, on stdout. @throws Error from its callback
void add_eval_command(CLI::App& app);

}  // namespace mms
