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

/// Draws the masks that can be objects, and counts the others. What an impossible mask covers is
/// judged without it.
/// @param draw  draws masks, and returns for every point 0 or 1 + index of the instance over it
/// @param left  of impossible masks, an empty image remains
template <class Draw>
std::vector<Plausibility> draw_possible_masks(const Draw& draw, const FusionConfig& config,
                                              Segmentation& left, LabeledCloud& cloud) {
  while (true) {
    const std::vector<std::uint16_t>& covering = draw(left);
    if (!config.plausibility) return {};
    const std::vector<Plausibility> judged = judge_masks(cloud, covering, left.instances, config);
    int dropped = 0;
    for (std::size_t k = 0; k < judged.size(); ++k) {
      if (judged[k] != Plausibility::kImpossible) continue;
      left.instances[k].mask = {};
      ++dropped;
    }
    if (dropped == 0) return judged;
    cloud.implausible_masks += dropped;
  }
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
  MaskImage mask;
  Segmentation left = segmentation;
  const auto draw = [&](const Segmentation& masks) -> const std::vector<std::uint16_t>& {
    mask = make_mask_image(masks, frame.depth.width(), frame.depth.height(), present_.stride,
                           present_.dilation);
    return mask.raw.pixels();
  };
  if (present_.mode == FusionMode::kVision) {
    draw(left);
    label_by_mask(mask.dilated.pixels(), left.instances, cloud);
    mark_dynamic_pixels(mask.dilated, cloud);
    return cloud;
  }
  const std::vector<Plausibility> judged = draw_possible_masks(draw, present_, left, cloud);
  std::vector<Instance>& instances = left.instances;
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
  MaskImage mask;
  PointMask covering;
  Segmentation left = segmentation;
  const auto draw = [&](const Segmentation& masks) -> const std::vector<std::uint16_t>& {
    mask = make_mask_image(masks, calibration.camera->width, calibration.camera->height,
                           present_.stride, present_.dilation);
    covering = project_masks(cloud.points, mask, calibration, present_.stride);
    return covering.raw;
  };
  if (present_.mode == FusionMode::kVision) {
    draw(left);
    label_by_mask(covering.dilated, left.instances, cloud);
  } else {
    draw_possible_masks(draw, present_, left, cloud);
    fuse_scan_geometry(mask, covering, left.instances, calibration, present_, cloud);
  }
  return cloud;
}

}  // namespace mms
