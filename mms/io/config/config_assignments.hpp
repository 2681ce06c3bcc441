#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Calls `visit` with a visitor that sets the fields given as "key=value"; a field of a group is
/// "group.key". The last value of a key counts.
/// @returns warnings, one line each: fields given under a former name
/// @param where  source of the assignments, for messages
/// @throws DataError at `where` for a text without "=", an unknown key (with the closest known
/// ones), and a value of a wrong type or out of range.
std::vector<std::string> assign_fields(std::span<const std::string> assignments,
                                       const std::string& where,
                                       const std::function<void(ConfigVisitor&)>& visit);

/// Sets fields of a config struct (core/config.hpp). On an error `config` is unchanged. Returns and
/// throws as `assign_fields`.
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
