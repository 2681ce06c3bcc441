#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

namespace mms {

/// Indices of connected nodes.
using Component = std::vector<std::size_t>;

/// The search for components that moved, of depth images (`ImageNodes`) and LiDAR scans
/// (`ScanNodes`). `Nodes` thins a cloud and defines
/// - kMaxNoReturnShare, kMinContacts: gates;
/// - for_each_neighbor(node, visit): the nodes on the same surface beside a node;
/// - for_each_adjoining_cluster(node, visit): the cluster of each point beside a node;
/// - is_core(node, states): whether hardly any known surface is around a node in free space;
/// - boundary_nodes(states): nodes in free space beside a cluster;
/// - is_object(component): whether its size is that of an object;
/// - relabel(component, cluster, cloud, moved), finish(cloud, moved): labels the points.
template <class Nodes>
class ComponentSearch {
 public:
  /// @param states  of the nodes; kNone for those that are not static
  ComponentSearch(Nodes& nodes, std::vector<SpaceState> states)
      : nodes_(nodes), states_(std::move(states)) {}

  /// Share of the static nodes that are in free space.
  double free_share() const {
    const auto free = std::count(states_.begin(), states_.end(), SpaceState::kFree);
    const auto none = std::count(states_.begin(), states_.end(), SpaceState::kNone);
    const auto known = static_cast<std::ptrdiff_t>(states_.size()) - none;
    return known == 0 ? 0.0 : static_cast<double>(free) / static_cast<double>(known);
  }

  /// Makes the points of all components dynamic, as `MotionSegmentation::relabel` says.
  /// @returns non-zero at these points; empty without any
  Image<std::uint8_t> relabel(LabeledCloud& cloud) {
    for (std::size_t node = 0; node < states_.size(); ++node) {
      if (nodes_.is_core(node, states_)) relabel_from(node, Join::kAllowed, cloud);
    }
    // A part of an object that its mask omits may be too thin for a core.
    for (const std::size_t node : nodes_.boundary_nodes(states_)) {
      relabel_from(node, Join::kRequired, cloud);
    }
    nodes_.finish(cloud, moved_);
    return std::move(moved_);
  }

 private:
  enum class Join { kAllowed, kRequired };

  void relabel_from(std::size_t seed, Join join, LabeledCloud& cloud) {
    if (states_[seed] != SpaceState::kFree) return;
    const Component component = take_component(seed);
    if (!nodes_.is_object(component)) return;
    const int adjoining = adjoining_cluster(component, cloud.clusters.size());
    if (adjoining < 0 && join == Join::kRequired) return;
    if (moved_.empty()) moved_ = Image<std::uint8_t>(cloud.width, cloud.height);
    nodes_.relabel(component, adjoining < 0 ? add_unknown_cluster(cloud) : adjoining, cloud,
                   moved_);
  }

  /// The nodes in free space, or without a return behind, that are connected to `seed`; their
  /// states become kNone. Empty where too few of them are known to be in free space.
  Component take_component(std::size_t seed) {
    Component component{seed};
    states_[seed] = SpaceState::kNone;
    std::size_t no_return = 0;
    for (std::size_t k = 0; k < component.size(); ++k) {
      nodes_.for_each_neighbor(component[k], [&](std::size_t i) {
        if (states_[i] != SpaceState::kFree && states_[i] != SpaceState::kNoReturn) return;
        no_return += states_[i] == SpaceState::kNoReturn;
        states_[i] = SpaceState::kNone;
        component.push_back(i);
      });
    }
    const auto size = static_cast<double>(component.size());
    if (static_cast<double>(no_return) > Nodes::kMaxNoReturnShare * size) component.clear();
    return component;
  }

  /// The cluster beside most of the component's nodes: the component is a part of it that its mask
  /// omits. -1 without one.
  int adjoining_cluster(const Component& component, std::size_t clusters) const {
    std::vector<int> contacts(clusters, 0);
    for (const std::size_t node : component) {
      nodes_.for_each_adjoining_cluster(
          node, [&](int cluster) { ++contacts[static_cast<std::size_t>(cluster)]; });
    }
    const auto most = std::max_element(contacts.begin(), contacts.end());
    if (most == contacts.end() || *most < Nodes::kMinContacts) return -1;
    return static_cast<int>(most - contacts.begin());
  }

  Nodes& nodes_;
  std::vector<SpaceState> states_;
  Image<std::uint8_t> moved_;
};

}  // namespace mms
