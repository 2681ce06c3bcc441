#pragma once

// Internal to io: the only header that includes the JSON library.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Parses a whole file.
/// @throws FileError if it cannot be read; DataError if it is not JSON.
nlohmann::json parse_json(const std::filesystem::path& path);

/// A JSON value with its path, read strictly. Faults are DataErrors "file: annotations[3].bbox
/// what". References the value, which has to outlive the entry.
class JsonEntry {
 public:
  /// @param value  has to outlive the entry
  /// @param file   for messages
  /// @param path   of the value in the file, as in "annotations[3]"; empty for the whole file
  JsonEntry(const nlohmann::json& value, std::string file, std::string path = "")
      : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

  /// The value of a key.
  /// @throws DataError if this is not an object or misses the key.
  JsonEntry at(const std::string& key) const;
  /// Whether this is an object with that key.
  bool has(const std::string& key) const;

  /// The elements of a list.
  /// @throws DataError if it is not a list.
  std::vector<JsonEntry> elements() const;

  bool is_list() const { return value_->is_array(); }     ///< whether `elements` works
  bool is_text() const { return value_->is_string(); }    ///< whether `text` works
  bool is_object() const { return value_->is_object(); }  ///< whether `at` works

  /// @throws DataError if it is neither true nor false.
  bool boolean() const;

  /// @throws DataError if it has another type or is out of range.
  double number(Range range = {}) const;
  /// @throws DataError if it is no whole number or out of the range.
  std::int64_t integer(Range range = {}) const;
  /// @throws DataError if it is no string.
  std::string text() const;

  /// Throws the DataError "file: path what (hint)".
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const;

 private:
  std::string type_name() const;

  const nlohmann::json* value_;
  std::string file_;
  std::string path_;
};

}  // namespace mms
