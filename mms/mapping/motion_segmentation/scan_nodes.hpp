#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/voxels/cell_chains.hpp"
#include "mms/geometry/voxels/voxel_downsampling.hpp"
#include "mms/mapping/free_space/free_space_history.hpp"
#include "mms/mapping/motion_segmentation/component_search.hpp"

namespace mms {

/// Points within a fixed radius of any position.
class RadiusSearch {
 public:
  /// [m]: the radius. Source: above the spacing of the rings of a 16-beam LiDAR (2 degrees) at 10
  /// m.
  static constexpr float kRadius = 0.4F;

  explicit RadiusSearch(std::vector<Eigen::Vector3f> points);

  template <class Visit>
  void for_each_near(const Eigen::Vector3f& position, const Visit& visit) const {
    cells_.for_each_near(position, [&](std::size_t i) {
      if ((points_[i] - position).squaredNorm() <= kRadius * kRadius) visit(i);
    });
  }
  const std::vector<Eigen::Vector3f>& points() const { return points_; }

 private:
  std::vector<Eigen::Vector3f> points_;
  CellChains cells_;
};

/// The static points of a LiDAR scan, thinned by voxels, for `ComponentSearch`.
class ScanNodes {
 public:
  /// [-]: share of a component in space without a return behind. Source: by experiment on
  /// the scene warehouse_loop with the sensors lidar16 and lidar64.
  static constexpr double kMaxNoReturnShare = 0.5;
  /// [-]: contacts that join a component to a cluster. Source: as
  /// `kMaxNoReturnShare`.
  static constexpr int kMinContacts = 1;

  explicit ScanNodes(const LabeledCloud& cloud);

  std::size_t size() const { return nodes_.points().size(); }
  bool is_static(std::size_t) const { return true; }
  const Eigen::Vector3f& position(std::size_t node) const { return nodes_.points()[node]; }
  void set_states(const std::vector<SpaceState>&) {}

  template <class Visit>
  void for_each_neighbor(std::size_t node, const Visit& visit) const {
    nodes_.for_each_near(position(node), visit);
  }
  template <class Visit>
  void for_each_adjoining_cluster(std::size_t node, const Visit& visit) const {
    clustered_.for_each_near(position(node), [&](std::size_t i) { visit(clusters_[i]); });
  }
  bool is_core(std::size_t node, const std::vector<SpaceState>& states) const;
  /// None: without cores there is too little evidence in a sparse scan.
  std::vector<std::size_t> boundary_nodes(const std::vector<SpaceState>&) const { return {}; }
  /// Whether a component is as large as moving objects are, and no line: the rings of a scan hit
  /// different parts of a shelf's edge or of a cable each time.
  bool is_object(const Component& component) const;
  void relabel(const Component& component, int cluster, LabeledCloud& cloud,
               Image<std::uint8_t>& moved);
  void finish(LabeledCloud& cloud, Image<std::uint8_t>& moved) const;

 private:
  ScanNodes(const LabeledCloud& cloud, VoxelDownsampled voxels);

  std::vector<int> node_of_;  ///< of every point of the scan, -1 for none
  RadiusSearch nodes_;
  std::vector<int> new_cluster_;  ///< of every node, -1 for none
  std::vector<int> clusters_;     ///< of every clustered point
  RadiusSearch clustered_;        ///< points that fusion assigned to a cluster
};

}  // namespace mms
