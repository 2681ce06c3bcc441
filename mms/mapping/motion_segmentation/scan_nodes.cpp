#include "mms/mapping/motion_segmentation/scan_nodes.hpp"

#include <Eigen/Eigenvalues>
#include <limits>
#include <utility>

#include "mms/geometry/voxels/voxel_downsampling.hpp"
#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

namespace mms {
namespace {

/// [m]: side of the voxels whose mean is a node. Source: initial choice.
constexpr float kVoxel = 0.1F;
/// [-]: share of the nodes around a core that are on no known surface. Source: by experiment
/// on the scene warehouse_loop with the sensors lidar16 and lidar64.
constexpr double kMinOpenShare = 0.9;
/// [-]: share of the nodes around a core in free space. Source: as `kMinOpenShare`.
constexpr double kMinFreeShare = 0.5;
/// [-]: nodes of an object. Source: as `kMinOpenShare`.
constexpr std::size_t kMinNodes = 10;
/// [m]: standard deviation along a component's second direction. Source: as `kMinOpenShare`.
constexpr float kMinWidth = 0.08F;
/// [m]: side of a component's box. Source: longer than a forklift with its load.
constexpr float kMaxSize = 6.0F;

VoxelDownsampled thinned(const LabeledCloud& cloud) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Eigen::Vector3f> points = cloud.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cloud.labels[i] != PointLabel::kStatic) points[i].setConstant(kNan);
  }
  return voxel_downsample(points, kVoxel);
}

std::vector<Eigen::Vector3f> clustered_points(const LabeledCloud& cloud,
                                              std::vector<int>& clusters) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.cluster[i] < 0) continue;
    points.push_back(cloud.points[i]);
    clusters.push_back(cloud.cluster[i]);
  }
  return points;
}

}  // namespace

RadiusSearch::RadiusSearch(std::vector<Eigen::Vector3f> points)
    : points_(std::move(points)), cells_(points_.size(), kRadius) {
  for (std::size_t i = 0; i < points_.size(); ++i) cells_.insert(points_[i], i);
}

ScanNodes::ScanNodes(const LabeledCloud& cloud) : ScanNodes(cloud, thinned(cloud)) {}

ScanNodes::ScanNodes(const LabeledCloud& cloud, VoxelDownsampled voxels)
    : node_of_(std::move(voxels.voxel)),
      nodes_(std::move(voxels.points)),
      new_cluster_(nodes_.points().size(), -1),
      clustered_(clustered_points(cloud, clusters_)) {}

bool ScanNodes::is_core(std::size_t node, const std::vector<SpaceState>& states) const {
  if (states[node] != SpaceState::kFree) return false;
  std::size_t all = 0;
  std::size_t surface = 0;
  std::size_t free = 0;
  for_each_neighbor(node, [&](std::size_t i) {
    if (states[i] == SpaceState::kNone) return;  // of another component
    ++all;
    surface += states[i] == SpaceState::kSurface;
    free += states[i] == SpaceState::kFree;
  });
  const auto count = static_cast<double>(all);
  return static_cast<double>(surface) <= (1.0 - kMinOpenShare) * count &&
         static_cast<double>(free) >= kMinFreeShare * count;
}

bool ScanNodes::is_object(const Component& component) const {
  if (component.size() < kMinNodes) return false;
  const auto count = static_cast<float>(component.size());
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::AlignedBox3f box;
  for (const std::size_t i : component) {
    mean += position(i) / count;
    box.extend(position(i));
  }
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (const std::size_t i : component) {
    const Eigen::Vector3f d = position(i) - mean;
    covariance += d * d.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen(covariance, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()(1) >= kMinWidth * kMinWidth && box.sizes().maxCoeff() <= kMaxSize;
}

void ScanNodes::relabel(const Component& component, int cluster, LabeledCloud&,
                        Image<std::uint8_t>&) {
  for (const std::size_t i : component) new_cluster_[i] = cluster;
}

void ScanNodes::finish(LabeledCloud& cloud, Image<std::uint8_t>& moved) const {
  if (moved.empty()) return;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const int node = node_of_[i];
    const int cluster = node < 0 ? -1 : new_cluster_[static_cast<std::size_t>(node)];
    if (cluster < 0) continue;
    make_dynamic(i, cluster, cloud);
    moved[i] = 1;
  }
}

}  // namespace mms
