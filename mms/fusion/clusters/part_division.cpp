#include "mms/fusion/clusters/part_division.hpp"

#include <algorithm>
#include <map>

namespace mms {
namespace {

/// The nodes of a part under one mask.
struct Share {
  int instance = 0;
  int nodes = 0;
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
};

std::vector<Share> shares_of(const Nodes& nodes, const DynamicPart& part) {
  std::map<int, Share> shares;
  for (const std::size_t i : part.nodes) {
    if (nodes.raw[i] == 0) continue;
    Share& share = shares[nodes.raw[i] - 1];
    ++share.nodes;
    share.center += nodes.points[i];
  }
  std::vector<Share> list;
  for (auto& [instance, share] : shares) {
    share.instance = instance;
    share.center /= static_cast<float>(share.nodes);
    list.push_back(share);
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Share& a, const Share& b) { return a.nodes > b.nodes; });
  return list;
}

/// The masks with an object of their own, the largest first.
std::vector<Share> owners(const std::vector<Share>& shares, const DynamicPart& part, bool is_scan,
                          const FusionConfig& config) {
  const double least = std::max(static_cast<double>(config.min_points),
                                config.division_share * static_cast<double>(part.nodes.size()));
  const auto apart = static_cast<float>(config.division_distance);
  std::vector<Share> kept;
  for (const Share& share : shares) {
    if (share.nodes < least) continue;
    const bool is_apart = std::all_of(kept.begin(), kept.end(), [&](const Share& other) {
      // Across the floor; the sensor is held level, so a camera's y axis is upright, and a LiDAR's
      // z axis.
      const Eigen::Vector3f offset = share.center - other.center;
      return Eigen::Vector2f(offset.x(), is_scan ? offset.y() : offset.z()).norm() > apart;
    });
    if (is_apart) kept.push_back(share);
  }
  return kept;
}

std::size_t owner_of(const Nodes& nodes, std::size_t node, const std::vector<Share>& owners) {
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < owners.size(); ++k) {
    if (nodes.raw[node] == owners[k].instance + 1) return k;
    const float off = (nodes.points[node] - owners[k].center).squaredNorm();
    if (off < (nodes.points[node] - owners[nearest].center).squaredNorm()) nearest = k;
  }
  return nearest;
}

}  // namespace

std::vector<DynamicPart> divide_part(const Nodes& nodes, DynamicPart part,
                                     const FusionConfig& config) {
  const std::vector<Share> own = owners(shares_of(nodes, part), part, nodes.width == 0, config);
  std::vector<DynamicPart> parts;
  if (own.size() < 2) {
    parts.push_back(std::move(part));
    return parts;
  }
  parts.resize(own.size());
  for (std::size_t k = 0; k < own.size(); ++k) parts[k].instance = own[k].instance;
  for (const std::size_t i : part.nodes) parts[owner_of(nodes, i, own)].nodes.push_back(i);
  return parts;
}

}  // namespace mms
