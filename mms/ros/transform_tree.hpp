#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mms/ros/messages.hpp"

namespace mms {

Eigen::Isometry3d isometry_of(const msg::Pose& pose);
msg::Pose pose_message(const Eigen::Isometry3d& pose);

/// What /tf and /tf_static say: every frame's pose in its parent frame, over time.
class TransformTree {
 public:
  /// Transforms that are not finite are left out.
  void add(const msg::Transforms& message);

  /// Takes coordinates in `source` to coordinates in `target`, by the transforms whose stamps are
  /// nearest to `stamp`; nothing where the two frames are not connected.
  std::optional<Eigen::Isometry3d> lookup(const std::string& target, const std::string& source,
                                          Timestamp stamp) const;

  /// The frame that `frame` hangs from in the end: itself where it has no parent.
  std::string root_of(const std::string& frame) const;

  /// Stamps of the transform on the way from `frame` to its root that came most often; empty where
  /// all are static.
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

  std::map<std::string, Edge, std::less<>> edges_;  ///< by child
};

}  // namespace mms
