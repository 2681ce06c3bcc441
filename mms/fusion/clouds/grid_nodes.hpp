#pragma once

#include <algorithm>

#include "mms/core/labeled_cloud.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// The blocks of points of an organised cloud that share a node.
struct NodeGrid {
  int stride = 1;  ///< cloud points a side
  int width = 0;
  int height = 0;
  int cloud_width = 0;
  int cloud_height = 0;

  NodeGrid(const LabeledCloud& cloud, int cluster_stride)
      : stride(cluster_stride),
        width((cloud.width + stride - 1) / stride),
        height((cloud.height + stride - 1) / stride),
        cloud_width(cloud.width),
        cloud_height(cloud.height) {}

  std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }

  /// Calls `visit(i)` with the index of every point of the node in column `u` and row `v`.
  template <class Visit>
  void for_each_point(int u, int v, const Visit& visit) const {
    const int x_end = std::min(cloud_width, (u + 1) * stride);
    const int y_end = std::min(cloud_height, (v + 1) * stride);
    for (int y = v * stride; y < y_end; ++y) {
      for (int x = u * stride; x < x_end; ++x) {
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(cloud_width) +
              static_cast<std::size_t>(x));
      }
    }
  }
};

/// Downsamples an organised cloud: every node is the nearest point of its block, so that thin
/// objects in front are kept, with that point's mask values. `on_plane` is all zero.
Nodes make_grid_nodes(const LabeledCloud& cloud, const MaskImage& mask, const NodeGrid& grid,
                      const DepthNoise& noise);

}  // namespace mms
