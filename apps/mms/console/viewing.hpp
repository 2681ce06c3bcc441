#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "mms/run/record/run_options.hpp"
#include "mms/server/http/server.hpp"

namespace mms {

/// @param option  for the message
/// @throws CLI::ValidationError if the word is not a port.
std::uint16_t checked_port(const std::string& option, const std::string& word);

/// Adds --bind to a command.
void add_bind_option(CLI::App& command, ViewOptions& options);

/// Prints the viewer's address on stderr, with a warning if other machines can connect.
void announce(const ViewerServer& server, const ViewOptions& options);

/// Waits for Ctrl-C or SIGTERM.
void wait_for_interrupt();

}  // namespace mms
