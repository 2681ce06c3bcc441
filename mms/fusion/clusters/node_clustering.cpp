#include "mms/fusion/clusters/node_clustering.hpp"

#include <cstddef>

namespace mms {
namespace {

float gap_at(const Nodes& nodes, std::size_t node, Gap gap, const FusionConfig& config) {
  const double base = gap == Gap::kFine ? config.fine_tolerance : config.cluster_tolerance;
  return static_cast<float>(base) + static_cast<float>(config.noise_factor) * nodes.sigma[node];
}

}  // namespace

Clusters cluster_nodes(const Nodes& nodes, const std::vector<std::uint8_t>& keep, Gap gap,
                       const FusionConfig& config) {
  const ClusterSize size{config.min_points, config.max_points};
  if (nodes.width == 0) {
    return cluster_points(nodes.points, keep, static_cast<float>(config.lidar_tolerance), size);
  }
  std::vector<float> tolerance(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) tolerance[i] = gap_at(nodes, i, gap, config);
  return cluster_grid(nodes.points, nodes.width, keep, tolerance, size);
}

std::vector<int> count_contacts(const Nodes& nodes, const Clusters& clusters,
                                const std::vector<std::uint8_t>& source, Gap gap,
                                const FusionConfig& config) {
  std::vector<int> contacts(static_cast<std::size_t>(clusters.count), 0);
  if (nodes.width == 0) return contacts;
  const auto width = static_cast<std::size_t>(nodes.width);
  const auto touches = [&](std::size_t i, std::size_t j) {
    if (source[j] == 0 || clusters.label[j] != Clusters::kNone) return false;
    return (nodes.points[i] - nodes.points[j]).norm() <= gap_at(nodes, i, gap, config);
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (clusters.label[i] == Clusters::kNone) continue;
    const std::size_t x = i % width;
    const bool is_contact = (x > 0 && touches(i, i - 1)) || (x + 1 < width && touches(i, i + 1)) ||
                            (i >= width && touches(i, i - width)) ||
                            (i + width < nodes.size() && touches(i, i + width));
    contacts[static_cast<std::size_t>(clusters.label[i])] += is_contact ? 1 : 0;
  }
  return contacts;
}

}  // namespace mms
