#pragma once

// Internal to io: the only header that shows yaml-cpp.

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mms/core/config.hpp"

namespace mms {

/// A YAML mapping read strictly: every key has to be asked for, every value has to be of the type
/// and in the range asked for. Faults are ConfigErrors naming file:line and the key's whole path.
class YamlMap {
 public:
  /// @throws FileError when the file cannot be read, ConfigError when it is no YAML mapping.
  static YamlMap load(const std::filesystem::path& path);

  /// The value of `key`, which counts as known from now on; nothing where it is not written.
  std::optional<YAML::Node> find(std::string_view key);

  /// Gives the field's present name to a value that is written under its former one.
  /// @returns the warning to give the user; nothing where the former name is not used
  /// @throws ConfigError when the value is written under both names.
  std::optional<std::string> adopt_former(const FieldInfo& info);

  /// The mapping under `key`; an empty one where there is none.
  YamlMap child(std::string_view key);

  /// The mappings of the list under `key`; nothing where it is not written.
  /// @throws ConfigError when it is not a list of mappings.
  std::optional<std::vector<YamlMap>> children(std::string_view key);

  /// @throws ConfigError at the first key that was never asked for.
  void reject_unknown() const;

  /// @throws ConfigError when `node`, the value of `key`, is not a number in the range.
  double number(const YAML::Node& node, std::string_view key, Range range) const;
  /// @throws ConfigError when `node`, the value of `key`, is no whole number in the range.
  int integer(const YAML::Node& node, std::string_view key, Range range) const;

  /// Throws the ConfigError "file:line: path.to.key what (hint)".
  [[noreturn]] void fail(const YAML::Node& node, std::string_view key, const std::string& what,
                         const std::string& hint = "") const;

 private:
  YamlMap(std::string file, std::string path, std::optional<YAML::Node> node);
  void check_keys(const YAML::Node& map) const;

  std::string file_;
  std::string path_;  ///< "group.": what goes before a key in messages
  std::vector<std::pair<std::string, YAML::Node>> entries_;
  std::vector<std::string> known_;
};

/// "'text'" of a scalar, "a list" or "a group" else, for messages.
std::string shown(const YAML::Node& node);

/// Plain text of an unquoted scalar, empty for anything else.
std::string plain_scalar(const YAML::Node& node);

/// "0 to 10", "at least 0", "at most 10" or "any number".
std::string to_string(Range range);

}  // namespace mms
