#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Inclusive range of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Name, unit and meaning of one configuration value.
struct FieldInfo {
  std::string_view key;
  std::string_view unit;  ///< "m", "rad", ...; empty for none
  std::string_view doc;   ///< one line for `mms config dump`
  /// Its name in the version before, which is still read, with a warning; empty for none.
  std::string_view former{};
};

/// Visits the fields of a config struct in their order. Loading, dumping and checking are visitors
/// (io/config_yaml.hpp), so a field is declared once, beside the code it steers:
/// @code
/// struct KeyframeConfig {
///   double translation = 0.1;
///   void visit(ConfigVisitor& v) {
///     v.number({"translation", "m", "motion that makes a keyframe"}, translation, {0.0, 10.0});
///   }
/// };
/// @endcode
class ConfigVisitor {
 public:
  virtual ~ConfigVisitor() = default;

  virtual void number(const FieldInfo& info, double& value, Range range) = 0;
  virtual void integer(const FieldInfo& info, int& value, Range range) = 0;
  virtual void boolean(const FieldInfo& info, bool& value) = 0;
  /// `index` is the position in `choices` of the word chosen.
  virtual void choice(const FieldInfo& info, int& index,
                      std::span<const std::string_view> choices) = 0;

  /// A name or path; may be empty.
  virtual void text(const FieldInfo& info, std::string& value) = 0;

  /// An enumeration whose values are 0, 1, ... in the order of `choices`.
  template <class Enum>
  void enumeration(const FieldInfo& info, Enum& value, std::span<const std::string_view> choices) {
    int index = static_cast<int>(value);
    choice(info, index, choices);
    value = static_cast<Enum>(index);
  }

  /// A nested struct with a `visit` of its own.
  template <class Config>
  void group(const FieldInfo& info, Config& config) {
    begin_group(info);
    config.visit(*this);
    end_group();
  }

  /// Structs with a `visit` of their own, as many as the user gives.
  template <class Item>
  void list(const FieldInfo& info, std::vector<Item>& items) {
    items.resize(begin_list(info, items.size()));
    for (Item& item : items) {
      begin_item(info);
      item.visit(*this);
      end_item();
    }
    end_list();
  }

 protected:
  /// How many items there are to be; those beyond `size` are new. A list as it is, unless a visitor
  /// says otherwise.
  virtual std::size_t begin_list(const FieldInfo&, std::size_t size) { return size; }
  virtual void begin_item(const FieldInfo& info) { begin_group(info); }
  virtual void end_item() { end_group(); }
  virtual void end_list() {}

  virtual void begin_group(const FieldInfo& info) = 0;
  virtual void end_group() = 0;
};

}  // namespace mms
