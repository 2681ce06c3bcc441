#include "mms/fusion/clusters/grid_relabel.hpp"

#include <array>

#include "mms/fusion/clusters/label_propagation.hpp"

namespace mms {
namespace {

/// [-]: distance up to which a node has a seed, in relabel radii.
/// Source: initial choice; a node's points may be nearer to the seed than the node itself.
constexpr float kSeedReach = 3.0F;

/// Seeds that the points of one node may be close to: its own and those of the four nodes beside.
struct NodeSeeds {
  std::array<int, 5> seeds{};
  int count = 0;
};

NodeSeeds seeds_around(const NodeGrid& grid, const std::vector<int>& nearest, int u, int v) {
  constexpr std::array<std::array<int, 2>, 5> kAround = {
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  NodeSeeds result;
  for (const auto& [du, dv] : kAround) {
    if (u + du < 0 || u + du >= grid.width || v + dv < 0 || v + dv >= grid.height) continue;
    const int seed = nearest[static_cast<std::size_t>((v + dv) * grid.width + u + du)];
    if (seed < 0) continue;
    result.seeds[static_cast<std::size_t>(result.count++)] = seed;
  }
  return result;
}

/// The first seed at most `radius` [m] from `point`, else -1.
int find_seed(const NodeSeeds& around, const Nodes& nodes, const Eigen::Vector3f& point,
              float radius) {
  for (int k = 0; k < around.count; ++k) {
    const int seed = around.seeds[static_cast<std::size_t>(k)];
    const Eigen::Vector3f& near = nodes.points[static_cast<std::size_t>(seed)];
    if ((point - near).squaredNorm() <= radius * radius) return seed;
  }
  return -1;
}

}  // namespace

void relabel_grid(const NodeGrid& grid, const Nodes& nodes, const GridPlanes& planes,
                  const DynamicObjects& objects, const MaskImage& mask, const FusionConfig& config,
                  LabeledCloud& cloud) {
  const auto radius = static_cast<float>(config.relabel_radius);
  const auto noise_factor = static_cast<float>(config.noise_factor);
  const std::vector<int> nearest =
      nearest_seeds(nodes, objects.label, kSeedReach * radius, kSeedReach * noise_factor);
  std::size_t n = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u, ++n) {
      const NodeSeeds around = seeds_around(grid, nearest, u, v);
      const bool is_unanchored = objects.loose[n] != 0;
      if (around.count == 0 && !is_unanchored) continue;
      grid.for_each_point(u, v, [&](std::size_t i) {
        if (cloud.labels[i] == PointLabel::kInvalid) return;
        const Eigen::Vector3f& point = cloud.points[i];
        const float sigma = config.noise.depth.sigma(point.z());
        const int seed = find_seed(around, nodes, point, radius + noise_factor * sigma);
        if (seed < 0) {
          if (is_unanchored && mask.raw[i] != 0) cloud.labels[i] = PointLabel::kDynamic;
          return;
        }
        const float limit = config.planes.distance_limit(sigma);
        if (mask.raw[i] == 0 && is_on_plane(planes, n, point, limit)) return;
        cloud.labels[i] = PointLabel::kDynamic;
        cloud.cluster[i] = static_cast<std::int16_t>(objects.label[static_cast<std::size_t>(seed)]);
      });
    }
  }
}

}  // namespace mms
