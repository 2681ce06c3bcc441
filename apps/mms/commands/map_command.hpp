#pragma once

#include <string>

namespace mms {

/// Prints the sessions of a map file, for `mms info`.
void print_map_info(const std::string& path);

}  // namespace mms
