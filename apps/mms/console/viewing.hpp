#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "mms/run/record/view_options.hpp"
#include "mms/server/http/server.hpp"

namespace mms {

/// @param option  for the message
/// @throws CLI::ValidationError when the word is no port.
std::uint16_t checked_port(const std::string& option, const std::string& word);

/// Adds --bind to a command.
void add_bind_option(CLI::App& command, ViewOptions& options);

/// Says on stderr where the viewer is, and what it means if others can reach it.
void announce(const ViewerServer& server, const ViewOptions& options);

/// Lets time pass until Ctrl-C or SIGTERM.
void wait_for_interrupt();

}  // namespace mms
