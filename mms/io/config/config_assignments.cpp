#include "mms/io/config/config_assignments.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/nearest_word.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

class AssigningVisitor final : public ConfigVisitor {
 public:
  AssigningVisitor(std::span<const std::string> assignments, const std::string& where)
      : where_(where) {
    for (const std::string& text : assignments) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos) fail("'" + text + "' is not key=value");
      values_[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }

  void number(const FieldInfo& info, double& value, Range range) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    const std::optional<double> parsed = parse_double(*text);
    check(info, *text, range, parsed);
    value = *parsed;
  }

  void integer(const FieldInfo& info, int& value, Range range) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    std::optional<std::int64_t> parsed = parse_integer(*text);
    if (parsed && !std::in_range<int>(*parsed)) parsed.reset();
    check(info, *text, range, parsed);
    value = static_cast<int>(*parsed);
  }

  void boolean(const FieldInfo& info, bool& value) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    value = *text == "true" || *text == "1";
    if (!value && *text != "false" && *text != "0") {
      fail(path(info) + " is '" + *text + "', allowed: true, false");
    }
  }

  void choice(const FieldInfo& info, int& index,
              std::span<const std::string_view> choices) override {
    const std::optional<std::string> text = take(info);
    if (!text) return;
    const auto found = std::find(choices.begin(), choices.end(), *text);
    if (found == choices.end()) {
      const std::vector<std::string> known(choices.begin(), choices.end());
      fail(path(info) + " cannot be '" + *text + "'", suggestion(*text, known));
    }
    index = static_cast<int>(found - choices.begin());
  }

  void text(const FieldInfo& info, std::string& value) override {
    if (const std::optional<std::string> given = take(info)) value = *given;
  }

  /// To be called after the visit; fails on unknown keys.
  /// @returns warnings, one line each
  std::vector<std::string> finish() {
    if (values_.empty()) return std::move(warnings_);
    const std::string& key = values_.begin()->first;
    fail("unknown key '" + key + "'", suggestion(key, known_));
  }

 protected:
  void begin_group(const FieldInfo& info) override {
    adopt_former_group(info);
    groups_.emplace_back(info.key);
  }
  void end_group() override { groups_.pop_back(); }

 private:
  std::string path(const FieldInfo& info) const {
    std::string text;
    for (const std::string& group : groups_) text += group + ".";
    return text + std::string(info.key);
  }

  /// Renames a value given under its former name.
  void adopt(const std::string& former, const std::string& present) {
    const auto found = values_.find(former);
    if (found == values_.end()) return;
    warnings_.push_back(where_ + ": " + former + " is now called " + present);
    values_[present] = found->second;
    values_.erase(found);
  }

  void adopt_former_group(const FieldInfo& info) {
    if (info.former.empty()) return;
    const std::string former = path({.key = info.former, .unit = {}, .doc = {}}) + ".";
    std::vector<std::string> keys;
    for (const auto& [key, value] : values_) {
      if (key.starts_with(former)) keys.push_back(key);
    }
    for (const std::string& key : keys) adopt(key, path(info) + "." + key.substr(former.size()));
  }

  std::optional<std::string> take(const FieldInfo& info) {
    if (!info.former.empty()) adopt(path({.key = info.former, .unit = {}, .doc = {}}), path(info));
    known_.push_back(path(info));
    const auto found = values_.find(known_.back());
    if (found == values_.end()) return std::nullopt;
    std::string text = found->second;
    values_.erase(found);
    return text;
  }

  template <class Number>
  void check(const FieldInfo& info, const std::string& text, Range range,
             std::optional<Number> value) const {
    if (value && static_cast<double>(*value) >= range.min &&
        static_cast<double>(*value) <= range.max) {
      return;
    }
    fail(path(info) + " is '" + text + "', allowed: " + to_string(range));
  }

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw DataError(where_, what, hint);
  }

  std::string where_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> groups_;
  std::vector<std::string> known_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> assign_fields(std::span<const std::string> assignments,
                                       const std::string& where,
                                       const std::function<void(ConfigVisitor&)>& visit) {
  AssigningVisitor visitor(assignments, where);
  visit(visitor);
  return visitor.finish();
}

}  // namespace mms
