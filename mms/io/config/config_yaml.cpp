#include "mms/io/config/config_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/nearest_word.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

/// Sets fields from a file. The stack holds the current group and its parents.
class ConfigLoader final : public ConfigVisitor {
 public:
  explicit ConfigLoader(YamlMap map) { groups_.push_back(std::move(map)); }

  /// To be called after the visit; fails on unknown keys.
  /// @returns warnings, one line each
  std::vector<std::string> finish() {
    groups_.back().reject_unknown();
    return std::move(warnings_);
  }

  void number(const FieldInfo& info, double& value, Range range) override {
    if (const auto node = find(info)) {
      value = groups_.back().number(*node, info.key, range);
    }
  }

  void integer(const FieldInfo& info, int& value, Range range) override {
    if (const auto node = find(info)) {
      value = groups_.back().integer(*node, info.key, range);
    }
  }

  void boolean(const FieldInfo& info, bool& value) override {
    const auto node = find(info);
    if (!node) return;
    const std::string text = plain_scalar(*node);
    if (text != "true" && text != "false") {
      groups_.back().fail(*node, info.key, "is " + shown(*node) + ", allowed: true, false");
    }
    value = text == "true";
  }

  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    const auto node = find(info);
    if (!node) return;
    const std::string word = node->IsScalar() ? node->Scalar() : "";
    const auto found = std::find(choices.begin(), choices.end(), word);
    if (found == choices.end()) {
      const std::vector<std::string> words(choices.begin(), choices.end());
      std::string allowed;
      for (const std::string& known : words) allowed += (allowed.empty() ? "" : ", ") + known;
      const std::string hint = suggestion(word, words);
      groups_.back().fail(*node, info.key, "is " + shown(*node) + ", allowed: one of " + allowed,
                          hint.starts_with("did") ? hint : "");
    }
    index = static_cast<int>(found - choices.begin());
  }

  void text(const FieldInfo& info, std::string& value) override {
    const auto node = find(info);
    if (!node) return;
    if (!node->IsScalar()) {
      groups_.back().fail(*node, info.key, "is " + shown(*node) + ", expected a string");
    }
    value = node->Scalar();
  }

 private:
  void adopt_former(const FieldInfo& info) {
    if (const auto warning = groups_.back().adopt_former(info)) warnings_.push_back(*warning);
  }
  std::optional<YAML::Node> find(const FieldInfo& info) {
    adopt_former(info);
    return groups_.back().find(info.key);
  }
  std::size_t begin_list(const FieldInfo& info, std::size_t size) override {
    adopt_former(info);
    std::optional<std::vector<YamlMap>> items = groups_.back().children(info.key);
    lists_.push_back(items ? std::move(*items) : std::vector<YamlMap>());
    if (!items) lists_.back().resize(size, groups_.back().child(info.key));
    std::reverse(lists_.back().begin(), lists_.back().end());
    return lists_.back().size();
  }
  void begin_item(const FieldInfo&) override {
    groups_.push_back(std::move(lists_.back().back()));
    lists_.back().pop_back();
  }
  void end_list() override { lists_.pop_back(); }
  void begin_group(const FieldInfo& info) override {
    adopt_former(info);
    groups_.push_back(groups_.back().child(info.key));
  }
  void end_group() override {
    groups_.back().reject_unknown();
    groups_.pop_back();
  }

  std::vector<YamlMap> groups_;
  std::vector<std::string> warnings_;
  std::vector<std::vector<YamlMap>> lists_;  ///< remaining list items, the next one last
};

/// Writes one line per field: "key: value # doc [unit], allowed values".
class ConfigWriter final : public ConfigVisitor {
 public:
  const std::string& text() const { return text_; }

  void number(const FieldInfo& info, double& value, Range range) override {
    const std::string infinity = value > 0.0 ? ".inf" : "-.inf";
    field(info, std::isinf(value) ? infinity : format_number(value), to_string(range));
  }
  void integer(const FieldInfo& info, int& value, Range range) override {
    field(info, std::to_string(value), to_string(range));
  }
  void boolean(const FieldInfo& info, bool& value) override {
    field(info, value ? "true" : "false", "true or false");
  }
  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    std::string words;
    for (const std::string_view word : choices) {
      words += (words.empty() ? "" : " | ") + std::string(word);
    }
    field(info, std::string(choices[static_cast<std::size_t>(index)]), words);
  }
  void text(const FieldInfo& info, std::string& value) override {
    field(info, YAML::Dump(YAML::Node(value)), "a string");
  }

 private:
  void begin_group(const FieldInfo& info) override {
    if (!info.doc.empty()) text_ += indent_ + "# " + std::string(info.doc) + "\n";
    text_ += indent_ + std::string(info.key) + ":\n";
    indent_ += "  ";
  }
  void end_group() override { indent_.resize(indent_.size() - 2); }
  std::size_t begin_list(const FieldInfo& info, std::size_t size) override {
    if (!info.doc.empty()) text_ += indent_ + "# " + std::string(info.doc) + "\n";
    text_ += indent_ + std::string(info.key) + ":" + (size == 0 ? " []" : "") + "\n";
    return size;
  }
  void begin_item(const FieldInfo&) override {
    dash_ = true;
    indent_ += "    ";
  }
  void end_item() override { indent_.resize(indent_.size() - 4); }

  void field(const FieldInfo& info, const std::string& value, const std::string& allowed) {
    const std::string unit = info.unit.empty() ? "" : " [" + std::string(info.unit) + "]";
    text_ += dash_ ? indent_.substr(0, indent_.size() - 2) + "- " : indent_;
    dash_ = false;
    text_ += std::string(info.key) + ": " + value + "  # " + std::string(info.doc) + unit + ", " +
             allowed + "\n";
  }

  std::string text_;
  std::string indent_;
  bool dash_ = false;  ///< the next field is the first of a list item
};

}  // namespace

std::vector<std::string> load_config_fields(const std::filesystem::path& path,
                                            const std::function<void(ConfigVisitor&)>& visit) {
  ConfigLoader loader(YamlMap::load(path));
  visit(loader);
  return loader.finish();
}

std::vector<std::string> parse_config_fields(const std::string& text, const std::string& where,
                                             const std::function<void(ConfigVisitor&)>& visit) {
  ConfigLoader loader(YamlMap::parse(text, where));
  visit(loader);
  return loader.finish();
}

std::string dump_config_fields(const std::function<void(ConfigVisitor&)>& visit) {
  ConfigWriter writer;
  visit(writer);
  return writer.text();
}

std::vector<std::string> changed_settings(const std::string& yaml, const std::string& defaults) {
  std::istringstream lines(yaml);
  std::istringstream other_lines(defaults);
  std::vector<std::string> changed;
  std::vector<std::string> groups;
  for (std::string line, other; std::getline(lines, line) && std::getline(other_lines, other);) {
    const std::size_t indent = line.find_first_not_of(' ');
    const std::size_t colon = line.find(':');
    if (indent == std::string::npos || line[indent] == '#' || colon == std::string::npos) continue;
    groups.resize(indent / 2);
    if (line != other) {
      std::string path;
      for (const std::string& group : groups) path += group + ".";
      changed.push_back(path + line.substr(indent, line.find("  #") - indent));
    }
    groups.push_back(line.substr(indent, colon - indent));
  }
  return changed;
}

}  // namespace mms
