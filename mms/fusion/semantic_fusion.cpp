#include "mms/fusion/semantic_fusion.hpp"

#include <algorithm>

#include "mms/fusion/clouds/grid_nodes.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/clouds/scan_cloud.hpp"
#include "mms/fusion/clusters/cluster_list.hpp"
#include "mms/fusion/clusters/dynamic_objects.hpp"
#include "mms/fusion/clusters/grid_relabel.hpp"
#include "mms/fusion/clusters/scan_geometry.hpp"
#include "mms/fusion/masks/mask_labels.hpp"
#include "mms/fusion/masks/mask_plausibility.hpp"
#include "mms/fusion/masks/mask_weight.hpp"
#include "mms/fusion/planes/grid_planes.hpp"

namespace mms {
namespace {

/// III-B.2 for an organised cloud.
std::vector<DynamicObjects::Object> fuse_geometry(const MaskImage& mask,
                                                  const std::vector<Instance>& instances,
                                                  const FusionConfig& config, LabeledCloud& cloud) {
  const NodeGrid grid(cloud, config.cluster_stride);
  Nodes nodes = make_grid_nodes(cloud, mask, grid, config.noise.depth);
  const GridPlanes planes = find_grid_planes(nodes, config.planes);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const float limit = config.planes.distance_limit(nodes.sigma[n]);
    nodes.on_plane[n] = is_on_plane(planes, n, nodes.points[n], limit) ? 1 : 0;
  }
  DynamicObjects objects = find_dynamic_objects(nodes, instances, config);
  relabel_grid(grid, nodes, planes, objects, mask, config, cloud);
  list_clusters(objects.objects, instances, cloud);
  return std::move(objects.objects);
}

/// Marks dynamic points, and masked pixels without a return.
void mark_dynamic_pixels(const Image<std::uint16_t>& mask, LabeledCloud& cloud) {
  for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
    const bool is_hidden = cloud.labels[i] == PointLabel::kInvalid && mask[i] != 0;
    cloud.dynamic_pixels[i] = is_hidden || cloud.labels[i] == PointLabel::kDynamic ? 1 : 0;
  }
}

/// Clears the masks that cannot be objects, and counts them.
/// @param covering  of every point: 0 or 1 + index of the instance over it
std::vector<Plausibility> drop_impossible_masks(const std::vector<std::uint16_t>& covering,
                                                const std::vector<Instance>& instances,
                                                const FusionConfig& config, MaskImage& mask,
                                                LabeledCloud& cloud) {
  if (!config.plausibility) return {};
  std::vector<Plausibility> judged = judge_masks(cloud, covering, instances, config);
  const auto count = std::count(judged.begin(), judged.end(), Plausibility::kImpossible);
  cloud.implausible_masks = static_cast<int>(count);
  if (count > 0) {
    clear_impossible_masks(judged, mask.raw.pixels());
    clear_impossible_masks(judged, mask.dilated.pixels());
  }
  return judged;
}

}  // namespace

SemanticFusion::SemanticFusion(const FusionConfig& config)
    : config_(config), present_(config), depth_cloud_(config), memory_(config) {}

LabeledCloud SemanticFusion::fuse(const Frame& frame, const Segmentation& segmentation) {
  const std::optional<CameraIntrinsics>& camera = frame.calibration->camera;
  if (camera) present_.stride = config_.stride_of(*camera);
  return frame.has_depth() ? fuse_depth(frame, segmentation) : fuse_scan(frame, segmentation);
}

LabeledCloud SemanticFusion::fuse_depth(const Frame& frame, const Segmentation& segmentation) {
  LabeledCloud cloud = depth_cloud_.build(frame);
  if (present_.mode == FusionMode::kNone) return cloud;
  MaskImage mask = make_mask_image(segmentation, frame.depth.width(), frame.depth.height(),
                                   present_.stride, present_.dilation);
  if (present_.mode == FusionMode::kVision) {
    label_by_mask(mask.dilated.pixels(), segmentation.instances, cloud);
    mark_dynamic_pixels(mask.dilated, cloud);
    return cloud;
  }
  const std::vector<Plausibility> judged =
      drop_impossible_masks(mask.raw.pixels(), segmentation.instances, present_, mask, cloud);
  std::vector<Instance> instances = segmentation.instances;
  memory_.recall(cloud, mask, instances, is_computed(segmentation));
  std::vector<DynamicObjects::Object> objects;
  if (!instances.empty()) {
    objects = fuse_geometry(mask, instances, present_, cloud);
    mark_dynamic_pixels(mask.raw, cloud);
    dilate(cloud.dynamic_pixels, mask.radius);
  }
  memory_.remember(cloud, objects);
  weigh_masks(judged, cloud);
  return cloud;
}

LabeledCloud SemanticFusion::fuse_scan(const Frame& frame, const Segmentation& segmentation) {
  LabeledCloud cloud = build_scan_cloud(frame, present_);
  const Calibration& calibration = *frame.calibration;
  const bool has_masks = calibration.camera && !segmentation.instances.empty();
  if (present_.mode == FusionMode::kNone || !has_masks) return cloud;
  MaskImage mask = make_mask_image(segmentation, calibration.camera->width,
                                   calibration.camera->height, present_.stride, present_.dilation);
  PointMask covering = project_masks(cloud.points, mask, calibration, present_.stride);
  if (present_.mode == FusionMode::kVision) {
    label_by_mask(covering.dilated, segmentation.instances, cloud);
  } else {
    drop_impossible_masks(covering.raw, segmentation.instances, present_, mask, cloud);
    if (cloud.implausible_masks > 0) {
      covering = project_masks(cloud.points, mask, calibration, present_.stride);
    }
    fuse_scan_geometry(mask, covering, segmentation.instances, calibration, present_, cloud);
  }
  return cloud;
}

}  // namespace mms
