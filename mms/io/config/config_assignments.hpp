#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>

#include "mms/core/config.hpp"

namespace mms {

/// Lets `visit` go over a config's fields with a visitor that sets those assigned to by
/// "key=value"; a field of a group is "group.key". Of two values for one key the last one counts.
/// @param where  what the assignments come from, for messages
/// @throws DataError at `where` for a text without "=", an unknown key (with the nearest known
///         ones), and a value that is not of the key's type or out of its range.
void assign_fields(std::span<const std::string> assignments, const std::string& where,
                   const std::function<void(ConfigVisitor&)>& visit);

/// Sets fields of a config struct (core/config.hpp). On an error `config` stays as it was.
/// @throws DataError as `assign_fields` does.
template <class Config>
void assign(Config& config, std::span<const std::string> assignments, const std::string& where) {
  Config assigned = config;
  assign_fields(assignments, where, [&](ConfigVisitor& visitor) { assigned.visit(visitor); });
  config = std::move(assigned);
}

}  // namespace mms
