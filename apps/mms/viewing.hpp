#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "mms/server/server.hpp"
#include "view_options.hpp"

namespace mms {

/// @param option  for the message
/// @throws CLI::ValidationError when the word is no port.
std::uint16_t checked_port(const std::string& option, const std::string& word);

/// Adds --bind to a command.
void add_bind_option(CLI::App& command, ViewOptions& options);

/// Begins to serve, and says on stderr where, and what it means if others can reach it.
/// @param port_hint  how to choose another port, for the error when it is taken
/// @param background  whether its threads give way to all others
/// @throws DataError when the address or port cannot be listened at.
std::unique_ptr<ViewerServer> serve(const ViewOptions& options, std::shared_ptr<Scene> scene,
                                    const std::string& port_hint, bool background);

/// Lets time pass until Ctrl-C or SIGTERM.
void wait_for_interrupt();

}  // namespace mms
