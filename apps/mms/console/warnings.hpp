#pragma once

#include <string>
#include <vector>

namespace mms {

/// Foreign bytes may be in a message: without control characters but line breaks, and cut if it
/// is long.
std::string printable(std::string text);

/// Writes a line "warning: ..." for each to stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace mms
