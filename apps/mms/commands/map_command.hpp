#pragma once

#include <string>

namespace mms {

/// Prints the sessions of a map file, for `mms info`.
/// @param json  as one JSON object
void print_map_info(const std::string& path, bool json);

}  // namespace mms
