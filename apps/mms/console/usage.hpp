#pragma once

#include <CLI/App.hpp>
#include <string>

namespace mms {

/// One line with the fault in the command line and the way to its help.
/// @param app    after a failed parse
/// @param error  the exception of the parser
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error);

}  // namespace mms
