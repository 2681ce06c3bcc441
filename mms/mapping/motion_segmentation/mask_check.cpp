#include "mms/mapping/motion_segmentation/mask_check.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mms/geometry/parallel.hpp"

namespace mms {
namespace {

/// [-]: cloud points per node along either axis. Source: computing time, 1.5 ms/frame at most.
constexpr int kStep = 2;

/// [-]: share of a cluster's nodes that recent views must know to decide on the whole cluster.
/// Source: scene stop_and_go with false masks; with 0.3, a vehicle beside a wall under one false
/// mask became a part of the wall.
constexpr double kMinKnown = 0.7;

/// [-]: share of the known nodes on static surfaces that overrules a mask of no weight. Source: the
/// more of them decide.
constexpr double kEvenly = 0.5;

/// [nodes]: half width of the neighborhood that decides on a node of any other cluster.
/// Source: initial choice; as wide as the neighborhood of a feature.
constexpr int kReach = 2;

/// [nodes]: rows of a task. Source: computing time; about 1/15 of an image.
constexpr std::size_t kRowsPerChunk = 16;

/// What the views observed at the position of a node, the stronger evidence later.
enum class Seen : std::uint8_t { kNothing, kMasked, kSurface, kFree };

/// What recent views must show to overrule a mask: the less it weighs, the less.
struct Limits {
  double known;    ///< share of the nodes
  double surface;  ///< share of the known ones

  Limits(double weight, double agreement)
      : known(weight * kMinKnown), surface(kEvenly + weight * (agreement - kEvenly)) {}
};

using SeenNodes = Image<Seen>;  ///< every second point of a cloud along either axis

bool is_against(Seen seen) {
  return seen == Seen::kFree || seen == Seen::kMasked;
}

/// What the views observed of a set of nodes.
struct Votes {
  int nodes = 0;
  int surface = 0;
  int against = 0;
  int free = 0;

  void add(Seen seen) {
    ++nodes;
    free += seen == Seen::kFree;
    surface += seen == Seen::kSurface;
    against += is_against(seen);
  }
  /// Share of the known nodes that are on surfaces; 0 without any.
  double agreement() const {
    return surface == 0 ? 0.0 : static_cast<double>(surface) / (surface + against);
  }
  bool are_static(const Limits& least) const {
    const int known = surface + against;
    return known > 0 && known >= least.known * nodes && surface >= least.surface * known;
  }
};

std::size_t point_of(const LabeledCloud& cloud, int node_x, int node_y) {
  return cloud.index(kStep * node_x, kStep * node_y);
}

/// Non-zero at the nodes that decide on a masked one: those within `kReach` of it.
Image<std::uint8_t> nodes_around_masks(const LabeledCloud& cloud) {
  Image<std::uint8_t> around(cloud.width / kStep, cloud.height / kStep);
  for (int y = 0; y < around.height(); ++y) {
    for (int x = 0; x < around.width(); ++x) {
      // A point beyond the last whole node counts to that one.
      bool is_masked = false;
      for (int dy = 0; dy <= kStep && !is_masked; ++dy) {
        for (int dx = 0; dx <= kStep && !is_masked; ++dx) {
          const int px = std::min(kStep * x + dx, cloud.width - 1);
          const int py = std::min(kStep * y + dy, cloud.height - 1);
          is_masked = cloud.labels[cloud.index(px, py)] == PointLabel::kDynamic;
        }
      }
      if (!is_masked) continue;
      for (int v = std::max(0, y - kReach); v <= std::min(y + kReach, around.height() - 1); ++v) {
        for (int u = std::max(0, x - kReach); u <= std::min(x + kReach, around.width() - 1); ++u) {
          around(u, v) = 1;
        }
      }
    }
  }
  return around;
}

/// @param point  in the view's sensor frame [m]
template <class View>
Seen seen_by(const View& view, const Eigen::Vector3f& point) {
  switch (view.all.state_at(point)) {
    case SpaceState::kFree:
      return Seen::kFree;
    case SpaceState::kSurface:
      return view.statics.state_at(point) == SpaceState::kSurface ? Seen::kSurface : Seen::kMasked;
    default:
      return Seen::kNothing;
  }
}

/// Calls body(x, y) for every node, on several threads.
template <class Body>
void for_each_node(const LabeledCloud& cloud, const Body& body) {
  const int width = cloud.width / kStep;
  const auto height = static_cast<std::size_t>(cloud.height / kStep);
  parallel_chunks(height, kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) body(x, y);
    }
  });
}

/// @param places  of earlier views, which are asked where recent ones know nothing
/// @param wanted  non-zero at the nodes to be observed; empty: all
template <class Query>
SeenNodes observe(const LabeledCloud& cloud, const Query& views, const PlaceViews::Query& places,
                  const Image<std::uint8_t>& wanted) {
  SeenNodes nodes(cloud.width / kStep, cloud.height / kStep, Seen::kNothing);
  for_each_node(cloud, [&](int x, int y) {
    if (!wanted.empty() && wanted(x, y) == 0) return;
    const std::size_t i = point_of(cloud, x, y);
    if (cloud.labels[i] == PointLabel::kInvalid) return;
    Seen& seen = nodes(x, y);
    views.for_each(cloud.points[i], [&](const auto& view, const Eigen::Vector3f& there) {
      if (seen != Seen::kFree) seen = std::max(seen, seen_by(view, there));
    });
    if (seen == Seen::kNothing && places.is_on_surface(cloud.points[i])) seen = Seen::kSurface;
  });
  return nodes;
}

/// The votes of the masked nodes.
Votes masked_votes(const LabeledCloud& cloud, const SeenNodes& nodes) {
  Votes votes;
  for (int y = 0; y < nodes.height(); ++y) {
    for (int x = 0; x < nodes.width(); ++x) {
      if (cloud.labels[point_of(cloud, x, y)] == PointLabel::kDynamic) votes.add(nodes(x, y));
    }
  }
  return votes;
}

/// Whether the views agree with a cluster as a whole, and what it takes at one of its points.
struct ClusterVerdict {
  Limits limits;
  bool is_static;
};

std::vector<ClusterVerdict> judge_clusters(const LabeledCloud& cloud, const SeenNodes& nodes,
                                           double agreement) {
  std::vector<Votes> votes(cloud.clusters.size());
  for (int y = 0; y < nodes.height(); ++y) {
    for (int x = 0; x < nodes.width(); ++x) {
      const std::size_t i = point_of(cloud, x, y);
      if (cloud.labels[i] != PointLabel::kDynamic || cloud.cluster[i] < 0) continue;
      votes[static_cast<std::size_t>(cloud.cluster[i])].add(nodes(x, y));
    }
  }
  std::vector<ClusterVerdict> verdicts;
  for (std::size_t c = 0; c < votes.size(); ++c) {
    const Limits limits(static_cast<double>(cloud.clusters[c].weight), agreement);
    verdicts.push_back({limits, votes[c].are_static(limits)});
  }
  return verdicts;
}

Votes votes_around(const SeenNodes& nodes, int x, int y) {
  Votes votes;
  for (int v = std::max(0, y - kReach); v <= std::min(y + kReach, nodes.height() - 1); ++v) {
    for (int u = std::max(0, x - kReach); u <= std::min(x + kReach, nodes.width() - 1); ++u) {
      votes.add(nodes(u, v));
    }
  }
  return votes;
}

/// Whether the views agree with the nodes around one.
bool agree_around(const SeenNodes& nodes, int x, int y, const Limits& least) {
  return !is_against(nodes(x, y)) && votes_around(nodes, x, y).are_static(least);
}

/// Calls body(index) for the dynamic points that count to a node. Points beyond the last whole node
/// count to that one.
template <class Body>
void for_each_dynamic_point(const LabeledCloud& cloud, const SeenNodes& nodes, int u, int v,
                            const Body& body) {
  const int right = u + 1 == nodes.width() ? cloud.width : kStep * (u + 1);
  const int bottom = v + 1 == nodes.height() ? cloud.height : kStep * (v + 1);
  for (int y = kStep * v; y < bottom; ++y) {
    for (int x = kStep * u; x < right; ++x) {
      const std::size_t i = cloud.index(x, y);
      if (cloud.labels[i] == PointLabel::kDynamic) body(i);
    }
  }
}

/// Share of the nodes with a return, masked or not, that are on static surfaces.
double share_on_surfaces(const LabeledCloud& cloud, const SeenNodes& nodes) {
  int valid = 0;
  int on_surface = 0;
  for (int y = 0; y < nodes.height(); ++y) {
    for (int x = 0; x < nodes.width(); ++x) {
      valid += cloud.labels[point_of(cloud, x, y)] != PointLabel::kInvalid;
      on_surface += nodes(x, y) == Seen::kSurface;
    }
  }
  return valid == 0 ? 0.0 : static_cast<double>(on_surface) / valid;
}

/// Non-zero at the dynamic points that are on static surfaces.
Image<std::uint8_t> overruled_points(const LabeledCloud& cloud, const SeenNodes& nodes,
                                     double agreement) {
  const std::vector<ClusterVerdict> verdicts = judge_clusters(cloud, nodes, agreement);
  const ClusterVerdict without_cluster{Limits(1.0, agreement), false};
  Image<std::uint8_t> overruled(cloud.width, cloud.height);
  for_each_node(cloud, [&](int u, int v) {
    std::optional<bool> agreed;
    for_each_dynamic_point(cloud, nodes, u, v, [&](std::size_t i) {
      const int cluster = cloud.cluster[i];
      const ClusterVerdict& verdict =
          cluster < 0 ? without_cluster : verdicts[static_cast<std::size_t>(cluster)];
      const bool with_cluster = verdict.is_static && !is_against(nodes(u, v));
      if (!with_cluster && !agreed) agreed = agree_around(nodes, u, v, verdict.limits);
      overruled[i] = with_cluster || *agreed ? 1 : 0;
    });
  });
  return overruled;
}

}  // namespace

MaskCheck::View::View(const LabeledCloud& cloud, double margin, const DepthNoise& noise)
    : all(cloud, margin, noise), statics(cloud, margin, noise, FreeSpace::Returns::kStatic) {}

MaskEvidence MaskCheck::compare(const LabeledCloud& cloud,
                                const Transform<World, Sensor>& T_world_sensor,
                                Points points) const {
  const bool all = points == Points::kAll;
  const SeenNodes nodes = observe(cloud, views_.query(cloud.stamp, T_world_sensor),
                                  places_.query(cloud.stamp, config_.memory, T_world_sensor),
                                  all ? Image<std::uint8_t>() : nodes_around_masks(cloud));
  MaskEvidence evidence;
  evidence.supported_share =
      all ? share_on_surfaces(cloud, nodes) : std::numeric_limits<double>::quiet_NaN();
  evidence.masked_agreement = masked_votes(cloud, nodes).agreement();
  evidence.overruled = overruled_points(cloud, nodes, config_.agreement);
  evidence.overruled_share = overruled_share(cloud, evidence.overruled);
  if (evidence.overruled_share == 0.0) evidence.overruled = {};
  return evidence;
}

Image<std::uint8_t> MaskCheck::uncontradicted(
    const LabeledCloud& cloud, const Transform<World, Sensor>& T_world_sensor) const {
  const SeenNodes nodes = observe(cloud, views_.query(cloud.stamp, T_world_sensor),
                                  places_.query(cloud.stamp, config_.memory, T_world_sensor),
                                  nodes_around_masks(cloud));
  Image<std::uint8_t> points(cloud.width, cloud.height);
  for_each_node(cloud, [&](int u, int v) {
    if (nodes(u, v) == Seen::kFree) return;
    const Votes around = votes_around(nodes, u, v);
    if (2 * around.free >= around.nodes) return;
    for_each_dynamic_point(cloud, nodes, u, v, [&](std::size_t i) { points[i] = 1; });
  });
  return points;
}

void MaskCheck::remember(const LabeledCloud& cloud,
                         const Transform<World, Sensor>& T_world_sensor) {
  if (!config_.enabled || !cloud.organised() || !views_.wants(cloud.stamp)) return;
  const auto add = [&](const LabeledCloud& view_cloud) {
    View view(view_cloud, config_.margin, noise_);
    places_.add(cloud.stamp, view.statics, T_world_sensor);
    views_.add(cloud.stamp, std::move(view), T_world_sensor);
  };
  if (cloud.overruled.empty()) {
    add(cloud);
    return;
  }
  LabeledCloud labeled = cloud;
  labeled.labels = labels_for_pose(cloud);
  add(labeled);
}

std::vector<PointLabel> labels_for_pose(const LabeledCloud& cloud) {
  std::vector<PointLabel> labels = cloud.labels;
  for (std::size_t i = 0; i < cloud.overruled.size(); ++i) {
    if (cloud.overruled[i] != 0) labels[i] = PointLabel::kStatic;
  }
  return labels;
}

}  // namespace mms
