#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/config.hpp"

namespace mms {

/// Lets `visit` go over a config's fields with a visitor that sets those written in the YAML file;
/// the others keep their values.
/// @returns warnings, one line each: settings written under a former name
/// @throws FileError when the file cannot be read.
/// @throws ConfigError naming file:line, the key's path, the value and what is allowed, for an
///         unknown or duplicate key, a wrong type or a value out of range.
std::vector<std::string> load_config_fields(const std::filesystem::path& path,
                                            const std::function<void(ConfigVisitor&)>& visit);

/// YAML of the fields that `visit` goes over, each with its doc, unit and allowed values.
std::string dump_config_fields(const std::function<void(ConfigVisitor&)>& visit);

/// Sets the fields of a config struct (core/config.hpp) that are written in a YAML file. On an
/// error `config` stays as it was. Returns and throws as `load_config_fields` does.
template <class Config>
std::vector<std::string> load_config(const std::filesystem::path& path, Config& config) {
  Config loaded = config;
  auto warnings = load_config_fields(path, [&](ConfigVisitor& visitor) { loaded.visit(visitor); });
  config = std::move(loaded);
  return warnings;
}

/// Documented YAML of a config struct; `load_config` reads exactly the same values back.
template <class Config>
std::string dump_config(Config config) {
  return dump_config_fields([&](ConfigVisitor& visitor) { config.visit(visitor); });
}

}  // namespace mms
