#include "tests/program/json_schema.hpp"

#include <algorithm>

namespace mms::testing {
namespace {

using Json = nlohmann::json;

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return type == "null" && value.is_null();
}

class Check {
 public:
  explicit Check(const Json& root) : root_(root) {}

  std::string fault(const Json& value, const Json& schema, const std::string& path) const {
    if (schema.contains("$ref")) {
      const std::string name = schema["$ref"].get<std::string>().substr(8);
      return fault(value, root_["$defs"].at(name), path);
    }
    if (!type_holds(value, schema)) return path + ": wrong type: " + value.dump();
    if (schema.contains("enum")) {
      const Json& all = schema["enum"];
      if (std::find(all.begin(), all.end(), value) == all.end()) return path + ": not in the enum";
    }
    if (value.is_number()) return number_fault(value, schema, path);
    if (value.is_object()) return object_fault(value, schema, path);
    if (value.is_array()) return array_fault(value, schema, path);
    return "";
  }

 private:
  static bool type_holds(const Json& value, const Json& schema) {
    const Json& type = schema.at("type");
    if (type.is_string()) return is_of_type(value, type);
    return std::any_of(type.begin(), type.end(),
                       [&](const Json& one) { return is_of_type(value, one); });
  }

  static std::string number_fault(const Json& value, const Json& schema, const std::string& path) {
    const double number = value;
    if (schema.contains("minimum") && number < schema["minimum"].get<double>()) {
      return path + ": below the minimum";
    }
    if (schema.contains("maximum") && number > schema["maximum"].get<double>()) {
      return path + ": above the maximum";
    }
    return "";
  }

  std::string object_fault(const Json& value, const Json& schema, const std::string& path) const {
    for (const std::string key : schema["required"]) {
      if (!value.contains(key)) return path + "." + key + ": missing";
    }
    const Json& more = schema["additionalProperties"];
    for (const auto& [key, item] : value.items()) {
      const std::string place = path + "." + key;
      const bool known = schema["properties"].contains(key);
      if (!known && more.is_boolean()) return place + ": not in the schema";
      std::string found = fault(item, known ? schema["properties"][key] : more, place);
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string array_fault(const Json& value, const Json& schema, const std::string& path) const {
    if (schema.contains("minItems") && value.size() < schema["minItems"].get<std::size_t>()) {
      return path + ": too short";
    }
    if (schema.contains("maxItems") && value.size() > schema["maxItems"].get<std::size_t>()) {
      return path + ": too long";
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      std::string found = fault(value[i], schema["items"], path + "[" + std::to_string(i) + "]");
      if (!found.empty()) return found;
    }
    return "";
  }

  const Json& root_;
};

}  // namespace

std::string schema_fault(const Json& value, const Json& schema) {
  return Check(schema).fault(value, schema, "$");
}

}  // namespace mms::testing
