#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mms::testing {

/// The modules each module may include besides itself.
using Arrows = std::map<std::string, std::set<std::string>>;

/// The arrows of docs/architecture.md.
const Arrows& arrows();

/// Checks every .hpp and .cpp below `root`/mms: includes along the arrows only, project headers as
/// "mms/..." from the root, `#pragma once` in every header.
/// @returns one line a fault, "file:line: what is wrong and what is allowed"; files in sorted
/// order.
std::vector<std::string> include_faults(const std::filesystem::path& root, const Arrows& allowed);

}  // namespace mms::testing
