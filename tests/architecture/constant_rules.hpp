#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mms::testing {

/// Checks every constant at the start of a line, `constexpr` or `const`, of arithmetic type or with
/// a number in its initializer: its own comment, directly above it or behind it, names the unit in
/// brackets ("[m]", "[m/s^2]", "[-]" for a count or ratio) and the origin of the value in a clause
/// that begins with "Source:". Infinity and NaN need none.
/// @param name  of the file, as it is to be reported
/// @returns one line a constant, "name:line: kName has no comment" or "... lacks unit, source"
std::vector<std::string> constant_faults(const std::string& name, const std::string& source);

/// The faults of every .hpp and .cpp in `folders` below `root`, files in sorted order.
std::vector<std::string> constant_faults(const std::filesystem::path& root,
                                         std::span<const char* const> folders);

}  // namespace mms::testing
