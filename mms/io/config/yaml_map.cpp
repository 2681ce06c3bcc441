#include "mms/io/config/yaml_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/nearest_word.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

std::string at_line(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

/// YAML spells infinity ".inf"; NaN is not accepted.
std::optional<double> yaml_number(const std::string& text) {
  if (text == ".inf") return std::numeric_limits<double>::infinity();
  if (text == "-.inf") return -std::numeric_limits<double>::infinity();
  const auto number = parse_double(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

/// Removes directives such as "%YAML:1.0", which OpenCV writes and YAML does not know.
std::string without_directives(const std::string& text) {
  std::string kept;
  kept.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text[at] != '%') kept.append(text, at, end - at);
    if (end < text.size()) kept += '\n';
    at = end + 1;
  }
  return kept;
}

}  // namespace

std::string shown(const YAML::Node& node) {
  if (node.IsMap()) return "a group";
  if (node.IsSequence()) return "a list";
  return node.IsScalar() ? "'" + node.Scalar() + "'" : "empty";
}

std::string plain_scalar(const YAML::Node& node) {
  constexpr const char* kQuotedTag = "!";
  return node.IsScalar() && node.Tag() != kQuotedTag ? node.Scalar() : "";
}

std::string to_string(Range range) {
  const bool low = std::isfinite(range.min);
  const bool high = std::isfinite(range.max);
  if (low && high) return format_number(range.min) + " to " + format_number(range.max);
  if (low) return "at least " + format_number(range.min);
  return high ? "at most " + format_number(range.max) : "any number";
}

YamlMap YamlMap::load(const std::filesystem::path& path) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 20U;  // [B]
  return parse(read_file(path, kMaxBytes), path.string());
}

YamlMap YamlMap::parse(const std::string& text, const std::string& where) {
  std::optional<YAML::Node> root;
  try {
    root.emplace(YAML::Load(without_directives(text)));
  } catch (const YAML::Exception& error) {
    throw ConfigError(at_line(where, error.mark), "is not YAML: " + error.msg);
  }
  return {where, "", root};
}

YamlMap::YamlMap(std::string file, std::string path, std::optional<YAML::Node> node)
    : file_(std::move(file)), path_(std::move(path)) {
  if (!node || node->IsNull()) return;
  if (!node->IsMap()) {
    throw ConfigError(at_line(file_, node->Mark()),
                      (path_.empty() ? "the file" : path_.substr(0, path_.size() - 1)) + " is " +
                          shown(*node) + ", expected lines of 'key: value'");
  }
  check_keys(*node);
  for (const auto& entry : *node) entries_.emplace_back(entry.first.Scalar(), entry.second);
}

void YamlMap::check_keys(const YAML::Node& map) const {
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const YAML::Node& key = entry.first;
    if (!key.IsScalar()) fail(key, shown(key), "is not a scalar, expected a key");
    if (!seen.insert(key.Scalar()).second) {
      fail(key, key.Scalar(), "appears twice", "keep one of them");
    }
  }
}

std::optional<YAML::Node> YamlMap::find(std::string_view key) {
  known_.emplace_back(key);
  for (const auto& [name, node] : entries_) {
    if (name == key) return node;
  }
  return std::nullopt;
}

std::optional<std::string> YamlMap::adopt_former(const FieldInfo& info) {
  if (info.former.empty()) return std::nullopt;
  const auto named = [](std::string_view key) {
    return [key](const auto& entry) { return entry.first == key; };
  };
  const auto former = std::find_if(entries_.begin(), entries_.end(), named(info.former));
  if (former == entries_.end()) return std::nullopt;
  if (std::any_of(entries_.begin(), entries_.end(), named(info.key))) {
    fail(former->second, info.former, "is the former name of " + path_ + std::string(info.key),
         "keep the new name only");
  }
  former->first = info.key;
  return at_line(file_, former->second.Mark()) + ": " + path_ + std::string(info.former) +
         " is now called " + path_ + std::string(info.key);
}

YamlMap YamlMap::child(std::string_view key) {
  return {file_, path_ + std::string(key) + ".", find(key)};
}

std::optional<std::vector<YamlMap>> YamlMap::children(std::string_view key) {
  const std::optional<YAML::Node> list = find(key);
  if (!list) return std::nullopt;
  if (!list->IsSequence()) fail(*list, key, "is " + shown(*list) + ", expected a list of groups");
  std::vector<YamlMap> items;
  for (const YAML::Node& item : *list) {
    const std::string name = std::string(key) + "[" + std::to_string(items.size()) + "]";
    items.push_back(YamlMap(file_, path_ + name + ".", item));
  }
  return items;
}

void YamlMap::reject_unknown() const {
  for (const auto& [name, node] : entries_) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    throw ConfigError(at_line(file_, node.Mark()), "unknown key '" + path_ + name + "'",
                      suggestion(name, known_));
  }
}

double YamlMap::number(const YAML::Node& node, std::string_view key, Range range) const {
  const auto value = yaml_number(plain_scalar(node));
  if (!value) fail(node, key, "is " + shown(node) + ", expected a number: " + to_string(range));
  if (*value < range.min || *value > range.max) {
    fail(node, key, "is " + node.Scalar() + ", allowed: " + to_string(range));
  }
  return *value;
}

int YamlMap::integer(const YAML::Node& node, std::string_view key, Range range) const {
  constexpr double kLow = std::numeric_limits<int>::min();
  constexpr double kHigh = std::numeric_limits<int>::max();
  range = {std::max(range.min, kLow), std::min(range.max, kHigh)};
  const auto value = parse_integer(plain_scalar(node));
  if (!value) {
    fail(node, key, "is " + shown(node) + ", expected an integer: " + to_string(range));
  }
  return static_cast<int>(number(node, key, range));
}

void YamlMap::fail(const YAML::Node& node, std::string_view key, const std::string& what,
                   const std::string& hint) const {
  throw ConfigError(at_line(file_, node.Mark()), path_ + std::string(key) + " " + what, hint);
}

}  // namespace mms
