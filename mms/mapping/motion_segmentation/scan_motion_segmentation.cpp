#include "mms/mapping/motion_segmentation/scan_motion_segmentation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "mms/geometry/voxels/cell_chains.hpp"
#include "mms/geometry/voxels/voxel_downsampling.hpp"
#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

namespace mms {
namespace {

constexpr float kVoxel = 0.1F;      // a node is the mean of a voxel's points [m]
constexpr float kReach = 0.4F;      // between neighbours: above the spacing of a scan's rings [m]
constexpr double kOpenShare = 0.9;  // of the nodes about a core that are on no known surface
constexpr double kFreeShare = 0.5;  // of them that stand in free space
constexpr std::size_t kMinNodes = 10;  // of a component
constexpr double kMaxNoReturn = 0.5;   // share of a component's nodes in space that was no_return
constexpr float kMinWidth = 0.08F;  // standard deviation along a component's second direction [m]
constexpr float kMaxSize = 6.0F;    // of a component [m]

using Component = std::vector<std::size_t>;  // of nodes

/// The means of the voxels with static points, and those points' nodes.
struct Nodes {
  explicit Nodes(const LabeledCloud& cloud) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Eigen::Vector3f> points = cloud.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cloud.labels[i] != PointLabel::kStatic) points[i].setConstant(kNan);
    }
    VoxelDownsampled voxels = voxel_downsample(points, kVoxel);
    positions = std::move(voxels.points);
    node = std::move(voxels.voxel);
  }

  std::vector<Eigen::Vector3f> positions;
  std::vector<int> node;  ///< of every point of the cloud, -1 for none
};

class Search {
 public:
  explicit Search(const std::vector<Eigen::Vector3f>& points)
      : points_(points), cells_(points.size(), kReach) {
    for (std::size_t i = 0; i < points.size(); ++i) cells_.insert(points[i], i);
  }

  /// Calls `visit(i)` for the points within reach of `point`.
  template <class Visit>
  void for_each_near(const Eigen::Vector3f& point, const Visit& visit) const {
    cells_.for_each_near(point, [&](std::size_t i) {
      if ((points_[i] - point).squaredNorm() <= kReach * kReach) visit(i);
    });
  }

 private:
  const std::vector<Eigen::Vector3f>& points_;
  CellChains cells_;
};

bool is_core(std::size_t node, const Nodes& nodes, const Search& search,
             const std::vector<SpaceState>& states) {
  if (states[node] != SpaceState::kFree) return false;
  std::size_t all = 0;
  std::size_t surface = 0;
  std::size_t free = 0;
  search.for_each_near(nodes.positions[node], [&](std::size_t i) {
    if (states[i] == SpaceState::kNone) return;  // taken by another component
    ++all;
    surface += states[i] == SpaceState::kSurface;
    free += states[i] == SpaceState::kFree;
  });
  const auto count = static_cast<double>(all);
  return static_cast<double>(surface) <= (1.0 - kOpenShare) * count &&
         static_cast<double>(free) >= kFreeShare * count;
}

/// The nodes that hang together with `core` and were not there before; taken out of `states`.
/// Empty where the views tell little of them.
Component take_component(std::size_t core, const Nodes& nodes, const Search& search,
                         std::vector<SpaceState>& states) {
  Component component{core};
  states[core] = SpaceState::kNone;
  std::size_t no_return = 0;
  for (std::size_t k = 0; k < component.size(); ++k) {
    search.for_each_near(nodes.positions[component[k]], [&](std::size_t i) {
      if (states[i] != SpaceState::kFree && states[i] != SpaceState::kNoReturn) return;
      no_return += states[i] == SpaceState::kNoReturn;
      states[i] = SpaceState::kNone;
      component.push_back(i);
    });
  }
  if (static_cast<double>(no_return) > kMaxNoReturn * static_cast<double>(component.size()))
    component.clear();
  return component;
}

/// Whether it is as large as components that move are, and no line: of a shelf's edge or a cable
/// the rings of a scan hit one part now and another then.
bool is_body(const Component& component, const Nodes& nodes) {
  if (component.size() < kMinNodes) return false;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::AlignedBox3f box;
  for (const std::size_t i : component) {
    mean += nodes.positions[i] / static_cast<float>(component.size());
    box.extend(nodes.positions[i]);
  }
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (const std::size_t i : component) {
    const Eigen::Vector3f d = nodes.positions[i] - mean;
    covariance += d * d.transpose() / static_cast<float>(component.size());
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen(covariance, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()(1) >= kMinWidth * kMinWidth && box.sizes().maxCoeff() <= kMaxSize;
}

std::vector<Component> find_components(const Nodes& nodes, std::vector<SpaceState> states) {
  const Search search(nodes.positions);
  std::vector<Component> components;
  for (std::size_t core = 0; core < states.size(); ++core) {
    if (!is_core(core, nodes, search, states)) continue;
    Component component = take_component(core, nodes, search, states);
    if (is_body(component, nodes)) components.push_back(std::move(component));
  }
  return components;
}

/// The points of the clusters that there are, to be searched by state.
class ClusterSearch {
 public:
  explicit ClusterSearch(const LabeledCloud& cloud)
      : clusters_(cloud.clusters.size()), points_(take_points(cloud)), search_(points_) {}

  /// The cluster next to which most of a component's nodes are; -1 where there is none.
  int adjoining(const Component& component, const Nodes& nodes) const {
    std::vector<int> votes(clusters_, 0);
    for (const std::size_t node : component) {
      search_.for_each_near(nodes.positions[node],
                            [&](std::size_t i) { ++votes[static_cast<std::size_t>(cluster_[i])]; });
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    return most == votes.end() || *most == 0 ? -1 : static_cast<int>(most - votes.begin());
  }

 private:
  std::vector<Eigen::Vector3f> take_points(const LabeledCloud& cloud) {
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      if (cloud.cluster[i] < 0) continue;
      points.push_back(cloud.points[i]);
      cluster_.push_back(cloud.cluster[i]);
    }
    return points;
  }

  std::size_t clusters_;
  std::vector<int> cluster_;
  std::vector<Eigen::Vector3f> points_;
  Search search_;
};

void make_dynamic(const std::vector<Component>& components, const Nodes& nodes,
                  LabeledCloud& cloud) {
  const ClusterSearch named(cloud);
  std::vector<int> cluster(nodes.positions.size(), -1);
  for (const Component& component : components) {
    const int next_to = named.adjoining(component, nodes);
    const int whole = next_to < 0 ? add_unknown_cluster(cloud) : next_to;
    for (const std::size_t i : component) cluster[i] = whole;
  }
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const int node = nodes.node[i];
    const int whole = node < 0 ? -1 : cluster[static_cast<std::size_t>(node)];
    if (whole >= 0) make_dynamic(i, whole, cloud);
  }
}

}  // namespace

bool ScanMotionSegmentation::relabel(LabeledCloud& cloud,
                                     const Transform<World, Sensor>& T_world_sensor) const {
  if (!config_.enabled || cloud.organised() || views_.empty()) return false;
  const Nodes nodes(cloud);
  const auto views = views_.query(cloud.stamp, T_world_sensor);
  std::vector<SpaceState> states(nodes.positions.size());
  std::transform(nodes.positions.begin(), nodes.positions.end(), states.begin(),
                 [&](const Eigen::Vector3f& point) { return views.state_of(point); });
  const auto free =
      static_cast<double>(std::count(states.begin(), states.end(), SpaceState::kFree));
  if (free > config_.max_share * static_cast<double>(states.size())) return false;
  const std::vector<Component> components = find_components(nodes, std::move(states));
  if (!components.empty()) make_dynamic(components, nodes, cloud);
  return !components.empty();
}

void ScanMotionSegmentation::remember(const LabeledCloud& cloud,
                                      const Transform<World, Sensor>& T_world_sensor) {
  if (!config_.enabled || cloud.organised() || !views_.wants(cloud.stamp)) return;
  views_.add(cloud.stamp, ScanFreeSpace(cloud, config_.margin + 2.0 * noise_), T_world_sensor);
}

}  // namespace mms
