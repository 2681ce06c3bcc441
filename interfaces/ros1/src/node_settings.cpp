#include "interfaces/ros1/src/node_settings.hpp"

#include <sstream>

#include <ros/console.h>

#include "mms/core/error.hpp"
#include "mms/io/config/config_assignments.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

std::string text_of(XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpc::XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    case XmlRpc::XmlRpcValue::TypeDouble:
      return format_number(static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    default:
      throw ConfigError("~settings", "is a list, expected a single value");
  }
}

/// "fusion.mode=vision" from the tree of a parameter.
void flatten(XmlRpc::XmlRpcValue& value, const std::string& key,
             std::vector<std::string>& assignments) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    assignments.push_back(key + "=" + text_of(value));
    return;
  }
  for (auto& [name, inner] : value) {
    flatten(inner, key.empty() ? name : key + "." + name, assignments);
  }
}

template <class T>
void read(const ros::NodeHandle& node, const char* name, T& value) {
  if (!node.hasParam(name) || node.getParam(name, value)) return;
  throw ConfigError(node.resolveName(name), "has another type than its default");
}

/// @throws ConfigError if the value is out of range.
template <class T>
void read(const ros::NodeHandle& node, const char* name, T& value, T least, T most) {
  read(node, name, value);
  if (value >= least && value <= most) return;
  std::ostringstream text;
  text << "is " << value << ", allowed: " << least << " to " << most;
  throw ConfigError(node.resolveName(name), text.str());
}

/// @throws ConfigError if it is not one of the choices.
/// @returns its index
std::size_t read_word(const ros::NodeHandle& node, const char* name, std::string value,
                      const std::vector<std::string>& words) {
  read(node, name, value);
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value) return i;
    all += (all.empty() ? "" : ", ") + words[i];
  }
  throw ConfigError(node.resolveName(name), "is '" + value + "', allowed: " + all);
}

}  // namespace

SystemConfig load_system_config(const ros::NodeHandle& node) {
  SystemConfig config;
  std::string file;
  read(node, "config", file);
  const auto warn = [](const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());
  };
  if (!file.empty()) warn(load_config(file, config));
  XmlRpc::XmlRpcValue tree;
  if (!node.getParam("settings", tree)) return config;
  std::vector<std::string> assignments;
  flatten(tree, "", assignments);
  warn(assign(config, assignments, node.resolveName("settings")));
  return config;
}

NodeSettings NodeSettings::load(const ros::NodeHandle& node) {
  NodeSettings s;
  s.sensor = static_cast<FrameAssembler::Sensor>(
      read_word(node, "sensor", "depth", {"depth", "cloud", "cloud_with_camera"}));
  const std::vector<std::string> kMasks = {"network", "remote", "none"};
  s.masks = kMasks[read_word(node, "masks", s.masks, kMasks)];
  s.color_compressed = read_word(node, "color_transport", "raw", {"raw", "compressed"}) == 1;
  s.depth_compressed = read_word(node, "depth_transport", "raw", {"raw", "compressed"}) == 1;
  s.udp = read_word(node, "mask_transport", "tcp", {"tcp", "udp"}) == 1;
  read(node, "queue_size", s.queue_size, 1, 1000);
  read(node, "mask_wait", s.mask_wait, 0.0, 10.0);
  read(node, "link_timeout", s.link_timeout, 0.1, 60.0);
  read(node, "remote_width", s.remote_width, 64, 16384);
  read(node, "remote_quality", s.remote_quality, 10, 100);
  read(node, "map_period", s.map_period, 0.1, 1e6);
  read(node, "publish_tf", s.publish_tf);
  read(node, "map_frame", s.map_frame);
  read(node, "world_frame", s.world_frame);
  read(node, "threads", s.threads, 0, 256);
  read(node, "results", s.results);
  s.system = load_system_config(node);
  return s;
}

}  // namespace mms
