#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/component_search.hpp"

namespace mms {

/// Every second point of an organised cloud along either axis, for `ComponentSearch`.
class ImageNodes {
 public:
  /// [-]: share of a component in space without a return behind. Source: by experiment on the
  /// scenes crowd and still_walker.
  static constexpr double kMaxNoReturnShare = 0.8;
  /// [-]: contacts that join a component to a cluster. Source: as `kMaxNoReturnShare`.
  static constexpr int kMinContacts = 5;

  /// @param radius  of the disc around a core [m]
  ImageNodes(const LabeledCloud& cloud, const DepthNoise& noise, double radius);

  std::size_t size() const { return static_cast<std::size_t>(width_ * height_); }
  bool is_static(std::size_t node) const {
    return cloud_.labels[point(node)] == PointLabel::kStatic;
  }
  const Eigen::Vector3f& position(std::size_t node) const { return cloud_.points[point(node)]; }

  /// Prepares `is_core`; to be called once the nodes' states are known.
  void set_states(const std::vector<SpaceState>& states);

  template <class Visit>
  void for_each_neighbor(std::size_t node, const Visit& visit) const {
    for_each_near(node, 1, [&](std::size_t other) { visit(other); });
  }
  template <class Visit>
  void for_each_adjoining_cluster(std::size_t node, const Visit& visit) const {
    for_each_near(node, kContactReach, [&](std::size_t other) {
      const int cluster = cloud_.cluster[point(other)];
      if (cluster >= 0) visit(cluster);
    });
  }
  bool is_core(std::size_t node, const std::vector<SpaceState>& states) const;
  std::vector<std::size_t> boundary_nodes(const std::vector<SpaceState>& states) const;
  bool is_object(const Component& component) const;
  void relabel(const Component& component, int cluster, LabeledCloud& cloud,
               Image<std::uint8_t>& moved) const;
  void finish(LabeledCloud&, Image<std::uint8_t>&) const {}

 private:
  /// Number of nodes with a state in any rectangle.
  class StateCounts {
   public:
    StateCounts() = default;
    template <class Counts>
    StateCounts(const std::vector<SpaceState>& states, int width, int height, const Counts& counts);
    /// Within `radius` nodes along either axis.
    int around(int x, int y, int radius) const;

   private:
    Image<int> sums_;
  };

  /// [-]: cloud points per node along either axis. Source: initial choice; a quarter of the work.
  static constexpr int kStep = 2;
  /// [-]: nodes from a component to a cluster that it adjoins. Source: as `kMaxNoReturnShare`.
  static constexpr int kContactReach = 2;

  std::size_t point(std::size_t node) const {
    return cloud_.index(kStep * column(node), kStep * row(node));
  }
  int column(std::size_t node) const { return static_cast<int>(node) % width_; }
  int row(std::size_t node) const { return static_cast<int>(node) / width_; }
  float depth(std::size_t node) const { return position(node).z(); }
  /// Largest difference of depth between neighbors on one surface [m].
  float max_gap(float depth) const;

  /// Calls `visit(node)` for the nodes within `reach` along either axis and of about the same
  /// depth, itself included.
  template <class Visit>
  void for_each_near(std::size_t node, int reach, const Visit& visit) const {
    const int cx = column(node);
    const int cy = row(node);
    const float z = depth(node);
    const float gap = max_gap(z);
    for (int y = std::max(0, cy - reach); y <= std::min(cy + reach, height_ - 1); ++y) {
      for (int x = std::max(0, cx - reach); x <= std::min(cx + reach, width_ - 1); ++x) {
        const auto other = static_cast<std::size_t>(y * width_ + x);
        if (std::abs(depth(other) - z) <= gap) visit(other);
      }
    }
  }

  const LabeledCloud& cloud_;
  const DepthNoise& noise_;
  double radius_;
  int width_;
  int height_;
  StateCounts static_;
  StateCounts surface_;
  StateCounts free_;
};

}  // namespace mms
