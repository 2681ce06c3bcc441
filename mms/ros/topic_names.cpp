#include "mms/ros/topic_names.hpp"

#include <algorithm>
#include <cctype>

#include "mms/core/error.hpp"

namespace mms::msg {
namespace {

constexpr const char* kNameHint =
    "names have letters, digits and single '_'; parts are joined by '/' and begin with no digit";

bool is_name_part(std::string_view part) {
  if (part.empty() || std::isdigit(static_cast<unsigned char>(part[0])) != 0) return false;
  if (part.find("__") != std::string_view::npos) return false;
  return std::all_of(part.begin(), part.end(),
                     [](unsigned char c) { return c == '_' || (c < 128 && std::isalnum(c) != 0); });
}

/// @param name  begins with a slash
void check_parts(std::string_view name, const std::string& given, const std::string& where) {
  while (!name.empty()) {
    name.remove_prefix(1);
    const std::size_t end = std::min(name.find('/'), name.size());
    if (!is_name_part(name.substr(0, end))) {
      throw ConfigError(where, "is '" + given + "', which ROS 2 does not allow", kNameHint);
    }
    name.remove_prefix(end);
  }
}

}  // namespace

std::string full_topic_name(const std::string& name, const std::string& name_space,
                            const std::string& node, const std::string& where) {
  const std::string prefix = name_space == "/" ? "/" : name_space + "/";
  std::string full;
  if (name.starts_with('/')) {
    full = name;
  } else if (name.starts_with("~/")) {
    full = prefix + node + name.substr(1);
  } else {
    full = prefix + name;
  }
  check_parts(full, name, where);
  return full;
}

std::string full_namespace(const std::string& name_space, const std::string& where) {
  if (name_space.empty() || name_space == "/") return "/";
  const std::string full = name_space.starts_with('/') ? name_space : "/" + name_space;
  check_parts(full, name_space, where);
  return full;
}

void check_node_name(const std::string& name, const std::string& where) {
  if (is_name_part(name)) return;
  throw ConfigError(where, "is '" + name + "', which ROS 2 does not allow for nodes", kNameHint);
}

std::string dds_type_name(std::string_view type, std::string_view kind) {
  const std::size_t slash = type.find('/');
  return std::string(type.substr(0, slash)) + "::" + std::string(kind) +
         "::dds_::" + std::string(type.substr(slash + 1)) + "_";
}

}  // namespace mms::msg
