#include "mms/fusion/clusters/cluster_votes.hpp"

#include <algorithm>
#include <cstddef>

namespace mms {
namespace {

/// Nodes off the planes under each mask as segmented.
std::vector<int> instance_sizes(const Nodes& nodes, std::size_t instance_count) {
  std::vector<int> sizes(instance_count, 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool counts = nodes.raw[i] != 0 && nodes.on_plane[i] == 0 && nodes.points[i].allFinite();
    if (counts) ++sizes[nodes.raw[i] - std::size_t{1}];
  }
  return sizes;
}

}  // namespace

std::vector<ClusterVote> count_votes(const Nodes& nodes, const Clusters& clusters,
                                     std::size_t instance_count) {
  const auto cluster_count = static_cast<std::size_t>(clusters.count);
  std::vector<ClusterVote> votes(cluster_count);
  std::vector<int> table(cluster_count * instance_count, 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (clusters.label[i] == Clusters::kNone) continue;
    const auto c = static_cast<std::size_t>(clusters.label[i]);
    ++votes[c].nodes;
    votes[c].labelled += nodes.dilated[i] != 0;
    if (nodes.raw[i] == 0) continue;
    ++votes[c].raw;
    ++table[c * instance_count + nodes.raw[i] - 1];
  }
  const std::vector<int> sizes = instance_sizes(nodes, instance_count);
  for (std::size_t c = 0; c < cluster_count; ++c) {
    if (votes[c].raw == 0) continue;
    const auto begin = table.begin() + static_cast<std::ptrdiff_t>(c * instance_count);
    const auto most = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(instance_count));
    votes[c].instance = static_cast<int>(most - begin);
    votes[c].instance_share =
        static_cast<double>(*most) / sizes[static_cast<std::size_t>(votes[c].instance)];
  }
  return votes;
}

}  // namespace mms
