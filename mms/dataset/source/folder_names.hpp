#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Whether the file names of a folder have that one.
inline bool has_name(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace mms
