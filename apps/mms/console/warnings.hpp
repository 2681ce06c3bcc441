#pragma once

#include <string>
#include <vector>

namespace mms {

/// Foreign bytes may be in a message: without control characters, and cut if it is long.
std::string one_line(std::string text);

/// Writes a line "warning: ..." for each to stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace mms
