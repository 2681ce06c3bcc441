#pragma once

#include <CLI/App.hpp>
#include <string>

namespace mms {

/// One line that says what is wrong with the command line and where its help is.
/// @param app    after a failed parse
/// @param error  what the parse threw
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error);

}  // namespace mms
