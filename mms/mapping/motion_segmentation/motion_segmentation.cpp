#include "mms/mapping/motion_segmentation/motion_segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

namespace mms {
namespace {

constexpr int kStep = 2;               // cloud points a side that share a node
constexpr float kGap = 0.1F;           // between the depths of neighbours on one component [m]
constexpr double kOpenShare = 0.9;     // of the nodes in a disc that are on no known surface
constexpr double kFreeShare = 0.3;     // of them that stand in free space
constexpr std::size_t kMinNodes = 30;  // of a component
constexpr double kMaxNoReturn = 0.8;   // share of a component's nodes in space that was no_return
constexpr int kNextTo = 2;             // nodes from a component to a cluster that it adjoins
constexpr int kFewestNext = 5;         // of its nodes next to such a cluster

/// Every `kStep`-th point a row and column.
struct Nodes {
  explicit Nodes(const LabeledCloud& given)
      : cloud(given), width(given.width / kStep), height(given.height / kStep) {}

  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(kStep * y) * static_cast<std::size_t>(cloud.width) +
           static_cast<std::size_t>(kStep * x);
  }
  bool is_static(int x, int y) const { return cloud.labels[pixel(x, y)] == PointLabel::kStatic; }
  float depth(int x, int y) const { return cloud.points[pixel(x, y)].z(); }

  const LabeledCloud& cloud;
  int width;
  int height;
};

/// How many nodes of a kind lie in a square.
class Sums {
 public:
  template <class Counts>
  Sums(const Image<SpaceState>& image, const Counts& counts)
      : sums_(image.width() + 1, image.height() + 1) {
    for (int y = 0; y < image.height(); ++y) {
      int row = 0;
      for (int x = 0; x < image.width(); ++x) {
        row += counts(image(x, y)) ? 1 : 0;
        sums_(x + 1, y + 1) = sums_(x + 1, y) + row;
      }
    }
  }

  /// Within `radius` pixels along either axis.
  int around(int x, int y, int radius) const {
    const int left = std::max(0, x - radius);
    const int top = std::max(0, y - radius);
    const int right = std::min(sums_.width() - 1, x + radius + 1);
    const int bottom = std::min(sums_.height() - 1, y + radius + 1);
    return sums_(right, bottom) - sums_(left, bottom) - sums_(right, top) + sums_(left, top);
  }

 private:
  Image<int> sums_;
};

/// Nodes in free space about which hardly anything was there before.
std::vector<std::pair<int, int>> find_cores(const Nodes& nodes, const Image<SpaceState>& states,
                                            double radius) {
  const Sums all(states, [](SpaceState state) { return state != SpaceState::kNone; });
  const Sums surface(states, [](SpaceState state) { return state == SpaceState::kSurface; });
  const Sums free(states, [](SpaceState state) { return state == SpaceState::kFree; });
  std::vector<std::pair<int, int>> cores;
  for (int y = 0; y < nodes.height; ++y) {
    for (int x = 0; x < nodes.width; ++x) {
      if (states(x, y) != SpaceState::kFree) continue;
      const double pixels = radius * nodes.cloud.camera.fx / nodes.depth(x, y);
      const int reach = std::clamp(static_cast<int>(std::lround(pixels / kStep)), 1, nodes.width);
      const int side = 2 * reach + 1;
      const int here = all.around(x, y, reach);
      if (2 * here < side * side) continue;
      const bool is_open = surface.around(x, y, reach) <= (1.0 - kOpenShare) * here;
      if (is_open && free.around(x, y, reach) >= kFreeShare * here) cores.emplace_back(x, y);
    }
  }
  return cores;
}

/// The nodes that hang together with `core` and were not there before; they are taken out of
/// `states`. Empty for what is next to nothing, or of which the views tell little.
std::vector<std::pair<int, int>> take_component(const Nodes& nodes, std::pair<int, int> core,
                                                const DepthNoise& noise,
                                                Image<SpaceState>& states) {
  std::vector<std::pair<int, int>> component{core};
  states(core.first, core.second) = SpaceState::kNone;
  std::size_t no_return = 0;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const auto [cx, cy] = component[i];
    const float z = nodes.depth(cx, cy);
    const float gap = kGap + 2.0F * noise.sigma(z);
    for (int y = std::max(0, cy - 1); y <= std::min(cy + 1, nodes.height - 1); ++y) {
      for (int x = std::max(0, cx - 1); x <= std::min(cx + 1, nodes.width - 1); ++x) {
        const bool is_open =
            states(x, y) == SpaceState::kFree || states(x, y) == SpaceState::kNoReturn;
        if (!is_open || std::abs(nodes.depth(x, y) - z) > gap) continue;
        no_return += states(x, y) == SpaceState::kNoReturn;
        states(x, y) = SpaceState::kNone;
        component.emplace_back(x, y);
      }
    }
  }
  const auto size = static_cast<double>(component.size());
  const bool has_evidence =
      component.size() >= kMinNodes && static_cast<double>(no_return) <= kMaxNoReturn * size;
  if (!has_evidence) component.clear();
  return component;
}

/// Calls `visit` with the cluster of every node of one that a node adjoins, in the image and in
/// depth.
template <class Visit>
void for_each_adjoining(const Nodes& nodes, std::pair<int, int> node, const DepthNoise& noise,
                        const Visit& visit) {
  const auto [cx, cy] = node;
  const float z = nodes.depth(cx, cy);
  const float gap = kGap + 2.0F * noise.sigma(z);
  for (int y = std::max(0, cy - kNextTo); y <= std::min(cy + kNextTo, nodes.height - 1); ++y) {
    for (int x = std::max(0, cx - kNextTo); x <= std::min(cx + kNextTo, nodes.width - 1); ++x) {
      const int cluster = nodes.cloud.cluster[nodes.pixel(x, y)];
      if (cluster >= 0 && std::abs(nodes.depth(x, y) - z) <= gap) visit(cluster);
    }
  }
}

/// Nodes in free space next to a cluster: what a mask left out may be too thin for a disc.
std::vector<std::pair<int, int>> find_boundaries(const Nodes& nodes,
                                                 const Image<SpaceState>& states,
                                                 const DepthNoise& noise) {
  std::vector<std::pair<int, int>> boundaries;
  if (nodes.cloud.clusters.empty()) return boundaries;
  for (int y = 0; y < nodes.height; ++y) {
    for (int x = 0; x < nodes.width; ++x) {
      if (states(x, y) != SpaceState::kFree) continue;
      int adjoining = 0;
      for_each_adjoining(nodes, {x, y}, noise, [&](int) { ++adjoining; });
      if (adjoining > 0) boundaries.emplace_back(x, y);
    }
  }
  return boundaries;
}

/// The cluster that most of the component hangs together with, of which it is what the mask left
/// out; -1 where there is none.
int adjoining_cluster(const Nodes& nodes, const std::vector<std::pair<int, int>>& component,
                      const DepthNoise& noise) {
  std::vector<int> next_to(nodes.cloud.clusters.size(), 0);
  for (const auto& node : component) {
    for_each_adjoining(nodes, node, noise,
                       [&](int cluster) { ++next_to[static_cast<std::size_t>(cluster)]; });
  }
  const auto most = std::max_element(next_to.begin(), next_to.end());
  if (most == next_to.end() || *most < kFewestNext) return -1;
  return static_cast<int>(most - next_to.begin());
}

void make_dynamic(const std::vector<std::pair<int, int>>& component, int cluster,
                  LabeledCloud& cloud, Image<std::uint8_t>& moved) {
  for (const auto& [nx, ny] : component) {
    for (int y = kStep * ny; y < kStep * (ny + 1); ++y) {
      for (int x = kStep * nx; x < kStep * (nx + 1); ++x) {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(cloud.width) +
                       static_cast<std::size_t>(x);
        if (cloud.labels[i] != PointLabel::kStatic) continue;
        make_dynamic(i, cluster, cloud);
        cloud.dynamic_pixels[i] = 1;
        moved[i] = 1;
      }
    }
  }
}

}  // namespace

Image<std::uint8_t> MotionSegmentation::relabel(
    LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) const {
  if (!config_.enabled || !cloud.organised() || views_.empty()) return {};
  const Nodes nodes(cloud);
  const auto views = views_.query(cloud.stamp, T_world_sensor);
  Image<SpaceState> states(nodes.width, nodes.height, SpaceState::kNone);
  std::size_t count = 0;
  std::size_t free = 0;
  for (int y = 0; y < nodes.height; ++y) {
    for (int x = 0; x < nodes.width; ++x) {
      if (!nodes.is_static(x, y)) continue;
      states(x, y) = views.state_of(cloud.points[nodes.pixel(x, y)]);
      ++count;
      free += states(x, y) == SpaceState::kFree;
    }
  }
  if (static_cast<double>(free) > config_.max_share * static_cast<double>(count)) return {};
  if (cloud.dynamic_pixels.empty()) {
    cloud.dynamic_pixels = Image<std::uint8_t>(cloud.width, cloud.height);
  }
  if (cloud.cluster.empty()) cloud.cluster.assign(cloud.points.size(), -1);
  Image<std::uint8_t> moved;
  const auto take = [&](std::pair<int, int> seed, bool is_thin) {
    if (states(seed.first, seed.second) != SpaceState::kFree) return;
    const auto component = take_component(nodes, seed, noise_, states);
    if (component.empty()) return;
    const int cluster = adjoining_cluster(nodes, component, noise_);
    if (is_thin && cluster < 0) return;
    if (moved.empty()) moved = Image<std::uint8_t>(cloud.width, cloud.height);
    make_dynamic(component, cluster < 0 ? add_unknown_cluster(cloud) : cluster, cloud, moved);
  };
  for (const auto& core : find_cores(nodes, states, config_.radius)) take(core, false);
  for (const auto& boundary : find_boundaries(nodes, states, noise_)) take(boundary, true);
  return moved;
}

void MotionSegmentation::remember(const LabeledCloud& cloud,
                                  const Transform<World, Sensor>& T_world_sensor) {
  if (!config_.enabled || !cloud.organised() || !views_.wants(cloud.stamp)) return;
  views_.add(cloud.stamp, FreeSpace(cloud, config_.margin, noise_), T_world_sensor);
}

}  // namespace mms
