#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Calls `visit` with a visitor that sets the fields given in the YAML file; others keep their
/// values.
/// @returns warnings, one line each: settings under a former name
/// @throws FileError if the file cannot be read.
/// @throws ConfigError with file:line, key path, value and allowed values for an unknown or
/// duplicate key, a wrong type or a value out of range.
std::vector<std::string> load_config_fields(const std::filesystem::path& path,
                                            const std::function<void(ConfigVisitor&)>& visit);

/// The same of a text.
/// @param text   YAML
/// @param where  its source, for messages
/// @param visit  as above
std::vector<std::string> parse_config_fields(const std::string& text, const std::string& where,
                                             const std::function<void(ConfigVisitor&)>& visit);

/// YAML of the fields that `visit` visits, each with its doc, unit and allowed values.
std::string dump_config_fields(const std::function<void(ConfigVisitor&)>& visit);

/// Sets the fields of a config struct (core/config.hpp) from a YAML file. On an error `config` is
/// unchanged. Returns and throws as `load_config_fields`.
template <class Config>
std::vector<std::string> load_config(const std::filesystem::path& path, Config& config) {
  Config loaded = config;
  auto warnings = load_config_fields(path, [&](ConfigVisitor& visitor) { loaded.visit(visitor); });
  config = std::move(loaded);
  return warnings;
}

/// As `load_config`, of a text.
template <class Config>
std::vector<std::string> parse_config(const std::string& text, const std::string& where,
                                      Config& config) {
  Config parsed = config;
  auto warnings =
      parse_config_fields(text, where, [&](ConfigVisitor& visitor) { parsed.visit(visitor); });
  config = std::move(parsed);
  return warnings;
}

/// Settings of `yaml` that differ from those of `defaults`, as "group.key: value"; both are texts
/// of `dump_config_fields` of the same struct.
std::vector<std::string> changed_settings(const std::string& yaml, const std::string& defaults);

/// YAML of a config struct with descriptions; `load_config` reads the same values back.
template <class Config>
std::string dump_config(Config config) {
  return dump_config_fields([&](ConfigVisitor& visitor) { config.visit(visitor); });
}

}  // namespace mms
