#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Closed interval of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();  ///< smallest allowed value
  double max = std::numeric_limits<double>::infinity();   ///< largest allowed value
};

/// Name, unit and description of a setting.
struct FieldInfo {
  std::string_view key;   ///< name in YAML
  std::string_view unit;  ///< "m", "rad", ...; empty for none
  std::string_view doc;   ///< one line for `mms config dump`
  /// Name in the previous version, still read with a warning; empty for none.
  std::string_view former{};
};

/// Visits the fields of a config struct in order. Loading, dumping and checking are visitors
/// (io/config_yaml.hpp), so a field is declared once, next to the code that uses it:
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

  /// A number in the range.
  virtual void number(const FieldInfo& info, double& value, Range range) = 0;
  /// A whole number in the range.
  virtual void integer(const FieldInfo& info, int& value, Range range) = 0;
  /// True or false.
  virtual void boolean(const FieldInfo& info, bool& value) = 0;
  /// `index` is the index of the selected value in `choices`.
  virtual void choice(const FieldInfo& info, int& index,
                      std::span<const std::string_view> choices) = 0;

  /// A name or path; may be empty.
  virtual void text(const FieldInfo& info, std::string& value) = 0;

  /// An enumeration whose values are the indices into `choices`.
  template <class Enum>
  void enumeration(const FieldInfo& info, Enum& value, std::span<const std::string_view> choices) {
    int index = static_cast<int>(value);
    choice(info, index, choices);
    value = static_cast<Enum>(index);
  }

  /// A nested struct with a `visit` function.
  template <class Config>
  void group(const FieldInfo& info, Config& config) {
    begin_group(info);
    config.visit(*this);
    end_group();
  }

  /// A list of structs with a `visit` function.
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
  /// Returns the new number of items; added items are default-constructed.
  virtual std::size_t begin_list(const FieldInfo&, std::size_t size) { return size; }
  /// Before the fields of an item of a list.
  virtual void begin_item(const FieldInfo& info) { begin_group(info); }
  /// After the fields of an item of a list.
  virtual void end_item() { end_group(); }
  /// After the last item of a list.
  virtual void end_list() {}

  /// Before the fields of a nested struct.
  virtual void begin_group(const FieldInfo& info) = 0;
  /// After the fields of a nested struct.
  virtual void end_group() = 0;
};

}  // namespace mms
