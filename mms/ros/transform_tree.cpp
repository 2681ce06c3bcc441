#include "mms/ros/transform_tree.hpp"

#include <algorithm>
#include <iterator>

namespace mms {
namespace {

/// tf1 wrote frames with a leading slash.
std::string plain(const std::string& frame) {
  return frame.starts_with("/") ? frame.substr(1) : frame;
}

/// Interpolated between two stamps; outside the first or last one, as tf2.
Eigen::Isometry3d pose_at(const std::map<Timestamp, Eigen::Isometry3d>& transforms,
                          Timestamp stamp) {
  const auto after = transforms.lower_bound(stamp);
  if (after == transforms.end()) return std::prev(after)->second;
  if (after == transforms.begin() || after->first == stamp) return after->second;
  const auto before = std::prev(after);
  const double share = to_seconds(stamp - before->first) / to_seconds(after->first - before->first);
  const Eigen::Quaterniond first(before->second.linear());
  Eigen::Isometry3d T(first.slerp(share, Eigen::Quaterniond(after->second.linear())));
  T.translation() =
      (1.0 - share) * before->second.translation() + share * after->second.translation();
  return T;
}

}  // namespace

Eigen::Isometry3d isometry_of(const msg::Pose& pose) {
  const auto& [x, y, z, w] = pose.orientation;
  Eigen::Isometry3d isometry(Eigen::Quaterniond(w, x, y, z).normalized());
  isometry.translation() = Eigen::Map<const Eigen::Vector3d>(pose.position.data());
  return isometry;
}

msg::Pose pose_message(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d p = pose.translation();
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

void TransformTree::add(const msg::Transforms& message) {
  for (const msg::TransformStamped& transform : message.transforms) {
    const Eigen::Isometry3d pose = isometry_of(transform.transform);
    if (!pose.matrix().allFinite()) continue;
    Edge& edge = edges_[plain(transform.child_frame_id)];
    edge.parent = plain(transform.header.frame_id);
    auto& poses = edge.T_parent_child;
    const Timestamp stamp = transform.header.stamp;
    // The clock went back, as where a recording is played again.
    if (poses.size() == kept_ && stamp < poses.begin()->first) poses.clear();
    poses[stamp] = pose;
    if (poses.size() > kept_) poses.erase(poses.begin());
  }
}

std::vector<std::string> TransformTree::chain(const std::string& frame) const {
  std::vector<std::string> frames = {plain(frame)};
  for (auto found = edges_.find(frames.back()); found != edges_.end();
       found = edges_.find(frames.back())) {
    if (std::find(frames.begin(), frames.end(), found->second.parent) != frames.end()) break;
    frames.push_back(found->second.parent);
  }
  return frames;
}

Eigen::Isometry3d TransformTree::to_ancestor(const std::vector<std::string>& chain,
                                             const std::string& ancestor, Timestamp stamp) const {
  Eigen::Isometry3d T_ancestor_frame = Eigen::Isometry3d::Identity();
  for (const std::string& frame : chain) {
    if (frame == ancestor) break;
    T_ancestor_frame = pose_at(edges_.find(frame)->second.T_parent_child, stamp) * T_ancestor_frame;
  }
  return T_ancestor_frame;
}

std::optional<Eigen::Isometry3d> TransformTree::lookup(const std::string& target,
                                                       const std::string& source,
                                                       Timestamp stamp) const {
  const std::vector<std::string> above_target = chain(target);
  const std::vector<std::string> above_source = chain(source);
  for (const std::string& frame : above_target) {
    if (std::find(above_source.begin(), above_source.end(), frame) == above_source.end()) continue;
    return to_ancestor(above_target, frame, stamp).inverse() *
           to_ancestor(above_source, frame, stamp);
  }
  return std::nullopt;
}

std::string TransformTree::root_of(const std::string& frame) const {
  return chain(frame).back();
}

std::vector<Timestamp> TransformTree::stamps_above(const std::string& frame) const {
  const std::map<Timestamp, Eigen::Isometry3d>* most = nullptr;
  for (const std::string& child : chain(frame)) {
    const auto found = edges_.find(child);
    if (found == edges_.end() || found->second.T_parent_child.size() < 2) continue;
    if (most == nullptr || found->second.T_parent_child.size() > most->size()) {
      most = &found->second.T_parent_child;
    }
  }
  std::vector<Timestamp> stamps;
  if (most == nullptr) return stamps;
  for (const auto& [stamp, pose] : *most) stamps.push_back(stamp);
  return stamps;
}

}  // namespace mms
