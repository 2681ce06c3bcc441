#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mms/ros/ros_messages.hpp"

namespace mms {

Eigen::Isometry3d isometry_of(const msg::Pose& pose);
msg::Pose pose_message(const Eigen::Isometry3d& pose);

/// Content of /tf and /tf_static: every frame's pose in its parent frame over time.
class TransformTree {
 public:
  /// @param kept  transforms of each frame, the latest ones
  explicit TransformTree(std::size_t kept = SIZE_MAX) : kept_(kept) {}

  /// Ignores transforms that are not finite.
  void add(const msg::Transforms& message);

  /// Transform from `source` to `target` at `stamp`, each part interpolated as by tf2; nullopt if
  /// the frames are not connected.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source,
                                          Timestamp stamp) const;

  /// The root of the tree of `frame`: itself if it has no parent.
  std::string root_of(const std::string& frame) const;

  /// Stamps of the most frequent transform between `frame` and its root; empty if all are static.
  std::vector<Timestamp> stamps_above(const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    std::map<Timestamp, Eigen::Isometry3d> T_parent_child;
  };

  /// Frames from `frame` up to its root, both included.
  std::vector<std::string> chain(const std::string& frame) const;
  Eigen::Isometry3d to_ancestor(const std::vector<std::string>& chain, const std::string& ancestor,
                                Timestamp stamp) const;

  std::size_t kept_;
  std::map<std::string, Edge, std::less<>> edges_;  ///< by child
};

}  // namespace mms
