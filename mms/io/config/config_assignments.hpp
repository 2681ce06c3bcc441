#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/config.hpp"

namespace mms {

/// Lets `visit` go over a config's fields with a visitor that sets those assigned to by
/// "key=value"; a field of a group is "group.key". Of two values for one key the last one counts.
/// @returns warnings, one line each: fields given under a former name
/// @param where  what the assignments come from, for messages
/// @throws DataError at `where` for a text without "=", an unknown key (with the nearest known
///         ones), and a value that is not of the key's type or out of its range.
std::vector<std::string> assign_fields(std::span<const std::string> assignments,
                                       const std::string& where,
                                       const std::function<void(ConfigVisitor&)>& visit);

/// Sets fields of a config struct (core/config.hpp). On an error `config` stays as it was.
/// Returns and throws as `assign_fields` does.
template <class Config>
std::vector<std::string> assign(Config& config, std::span<const std::string> assignments,
                                const std::string& where) {
  Config assigned = config;
  auto warnings =
      assign_fields(assignments, where, [&](ConfigVisitor& visitor) { assigned.visit(visitor); });
  config = std::move(assigned);
  return warnings;
}

}  // namespace mms
