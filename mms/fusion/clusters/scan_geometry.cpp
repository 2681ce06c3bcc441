#include "mms/fusion/clusters/scan_geometry.hpp"

#include <algorithm>
#include <utility>

#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/clusters/cluster_list.hpp"
#include "mms/fusion/clusters/dynamic_objects.hpp"
#include "mms/fusion/planes/static_planes.hpp"
#include "mms/geometry/normals.hpp"
#include "mms/geometry/plane_segmentation.hpp"
#include "mms/geometry/voxels/cell_chains.hpp"
#include "mms/geometry/voxels/voxel_downsampling.hpp"

namespace mms {
namespace {

/// [m]: radius of the neighborhood of a normal.
/// Source: spacing of the rings of a 16-beam LiDAR (2 degrees) at 11 m.
constexpr float kNormalRadius = 0.4F;

/// [-]: approximate number of nodes that vote for planes.
/// Source: computing time; `PlaneRemoval::min_share` of them are 50 votes.
constexpr std::size_t kPlaneVotes = 2500;

Nodes make_nodes(const MaskImage& mask, const Calibration& calibration, const FusionConfig& config,
                 std::vector<Eigen::Vector3f> points) {
  Nodes nodes;
  nodes.points = std::move(points);
  nodes.sigma.assign(nodes.size(), static_cast<float>(config.noise.range));
  PointMask covering = project_masks(nodes.points, mask, calibration, config.stride);
  nodes.raw = std::move(covering.raw);
  nodes.dilated = std::move(covering.dilated);
  nodes.on_plane.assign(nodes.size(), 0);
  return nodes;
}

std::vector<Plane> find_scan_planes(const Nodes& nodes, const FusionConfig& config) {
  const std::size_t stride = std::max<std::size_t>(1, nodes.size() / kPlaneVotes);
  const auto normals = neighbourhood_normals(nodes.points, stride, kNormalRadius);
  const auto voxel = static_cast<float>(config.lidar_voxel);
  std::vector<PlaneSample> samples;
  std::vector<std::uint8_t> masked;
  for (std::size_t i = 0; i < nodes.size(); i += stride) {
    if (normals[i].isZero(0.0F)) continue;
    const float area = voxel * voxel * static_cast<float>(stride);
    samples.push_back(
        {nodes.points[i], normals[i], area, config.planes.distance_limit(nodes.sigma[i])});
    masked.push_back(nodes.raw[i] != 0);
  }
  return find_static_planes(samples, masked, config.planes);
}

bool is_on_any(const std::vector<Plane>& planes, const Eigen::Vector3f& point, float limit) {
  return std::any_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return plane.distance(point) <= limit; });
}

/// Search for dynamic nodes near points.
class DynamicNodeSearch {
 public:
  DynamicNodeSearch(const Nodes& nodes, const DynamicObjects& objects, float radius)
      : nodes_(nodes), objects_(objects), radius_(radius), cells_(nodes.size(), radius) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (objects.label[i] == DynamicObjects::kNone) continue;
      cells_.insert(nodes.points[i], i);
      bounds_.extend(nodes.points[i]);
    }
    bounds_.min().array() -= radius;
    bounds_.max().array() += radius;
  }

  /// Object of the nearest dynamic node within the radius of `point`, else kNone.
  int nearest_object(const Eigen::Vector3f& point) const {
    if (!bounds_.contains(point)) return DynamicObjects::kNone;
    float best = radius_ * radius_;
    int object = DynamicObjects::kNone;
    cells_.for_each_near(point, [&](std::size_t i) {
      const float distance2 = (nodes_.points[i] - point).squaredNorm();
      if (distance2 > best) return;
      best = distance2;
      object = objects_.label[i];
    });
    return object;
  }

 private:
  const Nodes& nodes_;
  const DynamicObjects& objects_;
  float radius_;
  CellChains cells_;
  Eigen::AlignedBox3f bounds_;
};

/// Transfers the dynamic objects to all points, as `relabel_grid` does.
/// @param node_of  by point
void relabel_scan(const Nodes& nodes, const std::vector<int>& node_of,
                  const DynamicObjects& objects, const std::vector<Plane>& planes,
                  const PointMask& covering, const FusionConfig& config, LabeledCloud& cloud) {
  // A node is the mean of its voxel, so its points are up to a voxel from it.
  const auto radius = static_cast<float>(config.relabel_radius + config.lidar_voxel);
  const float on_plane = config.planes.distance_limit(static_cast<float>(config.noise.range));
  const DynamicNodeSearch search(nodes, objects, radius);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == PointLabel::kInvalid) continue;
    const int object = search.nearest_object(cloud.points[i]);
    if (object == DynamicObjects::kNone) {
      const bool is_unanchored = objects.loose[static_cast<std::size_t>(node_of[i])] != 0;
      if (is_unanchored && covering.raw[i] != 0) cloud.labels[i] = PointLabel::kDynamic;
      continue;
    }
    if (covering.raw[i] == 0 && is_on_any(planes, cloud.points[i], on_plane)) continue;
    cloud.labels[i] = PointLabel::kDynamic;
    cloud.cluster[i] = static_cast<std::int16_t>(object);
  }
}

}  // namespace

void fuse_scan_geometry(const MaskImage& mask, const PointMask& covering,
                        const std::vector<Instance>& instances, const Calibration& calibration,
                        const FusionConfig& config, LabeledCloud& cloud) {
  VoxelDownsampled voxels = voxel_downsample(cloud.points, static_cast<float>(config.lidar_voxel));
  Nodes nodes = make_nodes(mask, calibration, config, std::move(voxels.points));
  const std::vector<Plane> planes = find_scan_planes(nodes, config);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const float limit = config.planes.distance_limit(nodes.sigma[i]);
    nodes.on_plane[i] = is_on_any(planes, nodes.points[i], limit) ? 1 : 0;
  }
  const DynamicObjects objects = find_dynamic_objects(nodes, instances, config);
  relabel_scan(nodes, voxels.voxel, objects, planes, covering, config, cloud);
  list_clusters(objects.objects, instances, cloud);
}

}  // namespace mms
