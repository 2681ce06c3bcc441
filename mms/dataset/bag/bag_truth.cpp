#include "mms/dataset/bag/bag_truth.hpp"

#include <algorithm>

#include "mms/core/error.hpp"

namespace mms {
namespace {

bool is_transforms(const std::string& type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

std::string type_of(const BagReader& bag, const std::string& topic) {
  for (const BagTopic& candidate : bag.topics()) {
    if (candidate.name == topic) return candidate.type;
  }
  return "";
}

void add(Trajectory& poses, Timestamp stamp, const Eigen::Isometry3d& pose) {
  const bool later = poses.empty() || poses.back().stamp < stamp;
  if (later && pose.matrix().allFinite()) {
    poses.push_back({stamp, Transform<World, Sensor>(pose)});
  }
}

/// Visits all messages of a topic that can be read.
template <class Message, class Visit>
void for_messages(const BagReader& bag, const std::string& topic,
                  std::vector<std::string>& warnings, const Visit& visit) {
  for (std::size_t i = 0; i < bag.count(topic); ++i) {
    try {
      visit(bag.read<Message>(topic, i));
    } catch (const DataError& error) {
      warnings.emplace_back(error.what());
    }
  }
}

/// @param pose_of  returns the msg::Pose of a message
template <class Message, class PoseOf>
Trajectory read_poses(const BagReader& bag, const std::string& topic,
                      std::vector<std::string>& warnings, const PoseOf& pose_of) {
  Trajectory poses;
  for_messages<Message>(bag, topic, warnings, [&](const Message& message) {
    add(poses, message.header.stamp, isometry_of(pose_of(message)));
  });
  return poses;
}

Trajectory poses_in_tree(const TransformTree& transforms, const std::string& sensor_frame,
                         const std::string& where) {
  const std::string root = transforms.root_of(sensor_frame);
  Trajectory poses;
  for (const Timestamp stamp : transforms.stamps_above(sensor_frame)) {
    if (const auto pose = transforms.lookup(root, sensor_frame, stamp)) add(poses, stamp, *pose);
  }
  if (!poses.empty()) return poses;
  throw DataError(where, "has no transform for the frame '" + sensor_frame + "' of the images");
}

}  // namespace

TransformTree read_transforms(const BagReader& bag, std::vector<std::string>& warnings) {
  TransformTree tree;
  for (const BagTopic& topic : bag.topics()) {
    if (!is_transforms(topic.type)) continue;
    for_messages<msg::Transforms>(bag, topic.name, warnings,
                                  [&](const msg::Transforms& message) { tree.add(message); });
  }
  return tree;
}

Trajectory read_truth(const BagReader& bag, const std::string& topic,
                      const TransformTree& transforms, const std::string& sensor_frame,
                      std::vector<std::string>& warnings) {
  const std::string type = type_of(bag, topic);
  if (is_transforms(type)) return poses_in_tree(transforms, sensor_frame, topic);
  if (type == "nav_msgs/Odometry") {
    return read_poses<msg::Odometry>(bag, topic, warnings, [](const auto& m) { return m.pose; });
  }
  if (type == "geometry_msgs/TransformStamped") {
    return read_poses<msg::TransformStamped>(bag, topic, warnings,
                                             [](const auto& m) { return m.transform; });
  }
  return read_poses<msg::PoseStamped>(bag, topic, warnings, [](const auto& m) { return m.pose; });
}

}  // namespace mms
