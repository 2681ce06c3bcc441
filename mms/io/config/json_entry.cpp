#include "mms/io/config/json_entry.hpp"

#include <cmath>

#include "mms/core/error.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
nlohmann::json parse_json(const std::filesystem::path& path) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{4} << 30U;  // [B]: LVIS has 1.1 GB
  constexpr std::size_t kMaxShown = 300;  // characters of a fault, which may quote the file
  try {
    return nlohmann::json::parse(read_file(path, kMaxBytes));
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();  // "[json.exception...] parse error at line 1, ..."
    const std::size_t end = what.find("] ");
    throw DataError(
        path.string(),
        "is not JSON: " +
            (end == std::string::npos ? what : what.substr(end + 2)).substr(0, kMaxShown));
  }
}

JsonEntry JsonEntry::at(const std::string& key) const {
  if (!value_->is_object()) fail("is " + type_name() + ", expected an object");
  const auto found = value_->find(key);
  if (found == value_->end()) fail("missing key '" + key + "'");
  return {*found, file_, path_.empty() ? key : path_ + "." + key};
}

bool JsonEntry::has(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

std::vector<JsonEntry> JsonEntry::elements() const {
  if (!value_->is_array()) fail("is " + type_name() + ", expected a list");
  std::vector<JsonEntry> list;
  list.reserve(value_->size());
  for (const nlohmann::json& element : *value_) {
    list.emplace_back(element, file_, path_ + "[" + std::to_string(list.size()) + "]");
  }
  return list;
}

double JsonEntry::number(Range range) const {
  if (!value_->is_number()) fail("is " + type_name() + ", expected a number");
  const auto number = value_->get<double>();
  if (number >= range.min && number <= range.max) return number;
  fail("is " + format_number(number) + ", allowed: " + to_string(range));
}

std::int64_t JsonEntry::integer(Range range) const {
  constexpr double kMax = 9.0e18;  // range in which doubles fit an int64
  const double value = number({std::max(range.min, -kMax), std::min(range.max, kMax)});
  if (value_->is_number_integer()) return value_->get<std::int64_t>();
  if (value != std::floor(value)) fail("is " + format_number(value) + ", expected an integer");
  return static_cast<std::int64_t>(value);
}

std::string JsonEntry::text() const {
  if (!value_->is_string()) fail("is " + type_name() + ", expected a string");
  return value_->get<std::string>();
}

bool JsonEntry::boolean() const {
  if (!value_->is_boolean()) fail("is " + type_name() + ", expected true or false");
  return value_->get<bool>();
}

void JsonEntry::fail(const std::string& what, const std::string& hint) const {
  throw DataError(file_ + (path_.empty() ? "" : ": " + path_), what, hint);
}

std::string JsonEntry::type_name() const {
  const std::string name = value_->type_name();
  return name == "array" ? "a list" : name == "object" ? "an object" : "a " + name;
}

}  // namespace mms
