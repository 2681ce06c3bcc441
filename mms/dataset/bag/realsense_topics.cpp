#include "mms/dataset/bag/realsense_topics.hpp"

#include <cmath>

#include "mms/core/error.hpp"
#include "mms/ros/transform_tree.hpp"

namespace mms {
namespace {

constexpr const char* kImageEnd = "/image/data";

/// "/device_0/sensor_0/Depth_0/" of the topic of a stream.
std::string stream_prefix(const std::string& image_topic) {
  return image_topic.substr(0, image_topic.rfind(kImageEnd) + 1);
}

/// "/device_0/sensor_0/" of the topic of a stream.
std::string sensor_prefix(const std::string& image_topic) {
  const std::string stream = stream_prefix(image_topic);
  return stream.substr(0, stream.rfind('/', stream.size() - 2) + 1);
}

/// The topic of a type that begins with `start`; empty for none.
std::string topic_with(const BagReader& bag, const std::string& start, const char* type) {
  for (const BagTopic& topic : bag.topics()) {
    if (topic.name.starts_with(start) && topic.type == type && topic.count > 0) return topic.name;
  }
  return "";
}

/// Pose of the reference of a stream's extrinsics, such as "0", in the stream's frame.
struct StreamPlace {
  std::string reference;
  Eigen::Isometry3d T_stream_reference;
};

std::optional<StreamPlace> place_of(const BagReader& bag, const std::string& image_topic) {
  const std::string start = stream_prefix(image_topic) + "tf/";
  const std::string topic = topic_with(bag, start, "geometry_msgs/Transform");
  if (topic.empty()) return std::nullopt;
  try {
    return StreamPlace{topic.substr(start.size()), isometry_of(bag.first<msg::Pose>(topic))};
  } catch (const DataError&) {  // as if it was not there: a warning tells that it is missing
    return std::nullopt;
  }
}

}  // namespace

bool is_realsense_stream(const std::string& image_topic) {
  return image_topic.starts_with("/device_") && image_topic.ends_with(kImageEnd) &&
         image_topic.find("/sensor_") != std::string::npos;
}

std::string realsense_camera_info(const std::string& image_topic) {
  return stream_prefix(image_topic) + "info/camera_info";
}

std::optional<double> realsense_depth_scale(const BagReader& bag, const std::string& depth_topic) {
  constexpr double kMinScale = 0.001;  // [units/m], as of --depth-scale
  constexpr double kMaxScale = 1e6;
  if (!is_realsense_stream(depth_topic)) return std::nullopt;
  const std::string options = sensor_prefix(depth_topic) + "option/";
  std::string topic = topic_with(bag, options + "Depth_Units/value", "std_msgs/Float32");
  if (topic.empty()) {  // as earlier versions wrote it
    topic = topic_with(bag, options + "Depth Units/value", "std_msgs/Float32");
  }
  if (topic.empty()) return std::nullopt;
  double scale = 0.0;
  try {
    scale = 1.0 / static_cast<double>(bag.first<msg::Float32>(topic).data);
  } catch (const DataError&) {  // the scale of most sensors is assumed, and can be given
    return std::nullopt;
  }
  if (!(scale >= kMinScale && scale <= kMaxScale)) return std::nullopt;
  // [-]: 0.001 m as float32 gives 999.99995 units per meter, and means 1000.
  constexpr double kRounding = 1e-6;
  const double whole = std::round(scale);
  return std::abs(scale - whole) < kRounding * scale ? whole : scale;
}

std::optional<Transform<Camera, Depth>> realsense_extrinsics(const BagReader& bag,
                                                             const std::string& color_topic,
                                                             const std::string& depth_topic) {
  if (!is_realsense_stream(color_topic) || !is_realsense_stream(depth_topic)) return std::nullopt;
  const auto color = place_of(bag, color_topic);
  const auto depth = place_of(bag, depth_topic);
  if (!color || !depth || color->reference != depth->reference) return std::nullopt;
  return Transform<Camera, Depth>(color->T_stream_reference * depth->T_stream_reference.inverse());
}

}  // namespace mms
