#include "mms/fusion/clouds/grid_nodes.hpp"

#include <limits>

namespace mms {

Nodes make_grid_nodes(const LabeledCloud& cloud, const MaskImage& mask, const NodeGrid& grid,
                      const DepthNoise& noise) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Nodes nodes;
  nodes.width = grid.width;
  nodes.points.assign(grid.size(), Eigen::Vector3f::Constant(kNan));
  nodes.sigma.assign(grid.size(), 0.0F);
  nodes.raw.assign(grid.size(), 0);
  nodes.dilated.assign(grid.size(), 0);
  nodes.on_plane.assign(grid.size(), 0);
  std::size_t n = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u, ++n) {
      grid.for_each_point(u, v, [&](std::size_t i) {
        const bool is_nearer = !(nodes.points[n].z() <= cloud.points[i].z());
        if (cloud.labels[i] == PointLabel::kInvalid || !is_nearer) return;
        nodes.points[n] = cloud.points[i];
        nodes.raw[n] = mask.raw[i];
        nodes.dilated[n] = mask.dilated[i];
      });
      nodes.sigma[n] = noise.sigma(nodes.points[n].z());
    }
  }
  return nodes;
}

}  // namespace mms
