#pragma once

// Internal to io: the only header that includes yaml-cpp.

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// A YAML mapping read strictly: unknown keys, wrong types and values out of range are errors.
/// Faults are ConfigErrors with file:line and the path of the key.
class YamlMap {
 public:
  /// @throws FileError if the file cannot be read; ConfigError if it is not a YAML mapping.
  static YamlMap load(const std::filesystem::path& path);

  /// The same of a text.
  /// @param text   YAML
  /// @param where  its source, for messages
  static YamlMap parse(const std::string& text, const std::string& where);

  /// The value of `key`, which is marked as known; nullopt if absent.
  std::optional<YAML::Node> find(std::string_view key);

  /// Renames a value given under its former name.
  /// @returns a warning; nullopt if the former name is not used
  /// @throws ConfigError if both names are used.
  std::optional<std::string> adopt_former(const FieldInfo& info);

  /// The mapping under `key`; empty if absent.
  YamlMap child(std::string_view key);

  /// The mappings of the list under `key`; nullopt if absent.
  /// @throws ConfigError if it is not a list of mappings.
  std::optional<std::vector<YamlMap>> children(std::string_view key);

  /// @throws ConfigError at the first unknown key.
  void reject_unknown() const;

  /// @throws ConfigError if `node`, the value of `key`, is not a number in the range.
  double number(const YAML::Node& node, std::string_view key, Range range) const;
  /// @throws ConfigError if `node`, the value of `key`, is no whole number in the range.
  int integer(const YAML::Node& node, std::string_view key, Range range) const;

  /// Throws the ConfigError "file:line: path.to.key what (hint)".
  [[noreturn]] void fail(const YAML::Node& node, std::string_view key, const std::string& what,
                         const std::string& hint = "") const;

 private:
  YamlMap(std::string file, std::string path, std::optional<YAML::Node> node);
  void check_keys(const YAML::Node& map) const;

  std::string file_;
  std::string path_;  ///< "group.": prefix of keys in messages
  std::vector<std::pair<std::string, YAML::Node>> entries_;
  std::vector<std::string> known_;
};

/// "'text'" of a scalar, else "a list" or "a group", for messages.
std::string shown(const YAML::Node& node);

/// Text of an unquoted scalar, else empty.
std::string plain_scalar(const YAML::Node& node);

/// "0 to 10", "at least 0", "at most 10" or "any number".
std::string to_string(Range range);

}  // namespace mms
