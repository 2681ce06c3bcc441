#pragma once

#include <string>
#include <vector>

namespace mms {

/// Writes a line "warning: ..." for each to stderr.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace mms
