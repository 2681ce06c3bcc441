#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mms::testing {

/// What sources may include. A module is a folder in mms/, or one of the folders beside it: apps,
/// interfaces, benchmarks, examples, tests.
struct IncludeRules {
  /// The modules each module may include besides itself.
  std::map<std::string, std::set<std::string>> modules;

  /// The folders of modules that have any, from the lowest to the highest: each may include those
  /// before it. "" is the module's own folder.
  std::map<std::string, std::vector<std::string>> folders;
};

/// The rules of docs/architecture.md.
const IncludeRules& include_rules();

/// Checks every .hpp and .cpp below the folders of `root` that hold sources: includes as the rules
/// allow, project headers in quotes with their path from the root, `#pragma once` in every header,
/// no folder with more than `kMaxFilesInFolder` sources, no two headers of one name.
/// @returns one line a fault, "file:line: what is wrong and what is allowed"; files in sorted
/// order.
std::vector<std::string> include_faults(const std::filesystem::path& root,
                                        const IncludeRules& rules);

inline constexpr std::size_t kMaxFilesInFolder = 30;

}  // namespace mms::testing
