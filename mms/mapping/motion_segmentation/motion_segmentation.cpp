#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"

#include <utility>
#include <vector>

#include "mms/mapping/motion_segmentation/component_search.hpp"
#include "mms/mapping/motion_segmentation/image_nodes.hpp"
#include "mms/mapping/motion_segmentation/scan_nodes.hpp"

namespace mms {
namespace {

/// [-]: sigmas of range noise added to `margin` for scans. Source: 95 % of the normal distribution;
/// `FreeSpace` adds the noise of depth images itself.
constexpr double kMarginSigmas = 2.0;

template <class Nodes, class Query>
Image<std::uint8_t> relabel_components(Nodes nodes, const Query& views, double max_share,
                                       LabeledCloud& cloud) {
  std::vector<SpaceState> states(nodes.size(), SpaceState::kNone);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (nodes.is_static(i)) states[i] = views.state_of(nodes.position(i));
  }
  nodes.set_states(states);
  ComponentSearch<Nodes> search(nodes, std::move(states));
  if (search.free_share() > max_share) return {};
  return search.relabel(cloud);
}

}  // namespace

Image<std::uint8_t> MotionSegmentation::relabel(
    LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) const {
  if (!config_.enabled || (cloud.organised() ? images_.empty() : scans_.empty())) return {};
  if (cloud.cluster.empty()) cloud.cluster.assign(cloud.points.size(), -1);
  if (!cloud.organised()) {
    return relabel_components(ScanNodes(cloud), scans_.query(cloud.stamp, T_world_sensor),
                              config_.max_share, cloud);
  }
  if (cloud.dynamic_pixels.empty()) {
    cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  }
  return relabel_components(ImageNodes(cloud, noise_.depth, config_.radius),
                            images_.query(cloud.stamp, T_world_sensor), config_.max_share, cloud);
}

void MotionSegmentation::remember(const LabeledCloud& cloud,
                                  const Transform<World, Sensor>& T_world_sensor) {
  if (!config_.enabled) return;
  if (!cloud.organised()) {
    if (!scans_.wants(cloud.stamp)) return;
    const double margin = config_.margin + kMarginSigmas * noise_.range;
    scans_.add(cloud.stamp, ScanFreeSpace(cloud, margin), T_world_sensor);
  } else if (images_.wants(cloud.stamp)) {
    images_.add(cloud.stamp, FreeSpace(cloud, config_.margin, noise_.depth), T_world_sensor);
  }
}

}  // namespace mms
