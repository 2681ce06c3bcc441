#pragma once

#include <CLI/App.hpp>

namespace mms {

/// `mms view`: shows a finished run in a browser.
void add_view_command(CLI::App& app);

}  // namespace mms
