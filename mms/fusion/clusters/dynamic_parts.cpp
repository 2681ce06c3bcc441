#include "mms/fusion/clusters/dynamic_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "mms/fusion/clusters/cluster_votes.hpp"
#include "mms/fusion/clusters/node_clustering.hpp"
#include "mms/fusion/clusters/part_division.hpp"
#include "mms/geometry/trimmed_box.hpp"

namespace mms {
namespace {

/// [-]: share of the nodes cut off at either end of each axis of a box.
/// Source: initial choice, not tuned since.
constexpr double kBoxTrim = 0.02;

/// [-]: nodes of an object of a scan that are too far apart for a cluster. Source: two rings on a
/// person.
constexpr std::size_t kMinSparseNodes = 6;

/// [-]: gap along the view between an object of a scan and what is behind it, in widths of the
/// class. Source: initial choice; 0.6 m for people.
constexpr float kSparseGap = 0.5F;

enum class Verdict { kStatic, kDynamic, kMixed };

/// Every cluster with a masked node as a part, without its box; empty for the others.
std::vector<DynamicPart> collect(const Nodes& nodes, const Clusters& clusters,
                                 const std::vector<ClusterVote>& votes) {
  std::vector<DynamicPart> parts(votes.size());
  for (std::size_t c = 0; c < parts.size(); ++c) parts[c].instance = votes[c].instance;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (clusters.label[i] == Clusters::kNone) continue;
    const auto c = static_cast<std::size_t>(clusters.label[i]);
    if (votes[c].raw > 0) parts[c].nodes.push_back(i);
  }
  return parts;
}

Eigen::AlignedBox3f box_of(const Nodes& nodes, const DynamicPart& part) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(part.nodes.size());
  for (const std::size_t i : part.nodes) points.push_back(nodes.points[i]);
  return trimmed_box(points, kBoxTrim);
}

/// The loose nodes of a scan under one mask, then the groups that gaps along the view divide them
/// into, the nearest first.
std::vector<std::vector<std::size_t>> sparse_groups(const Nodes& nodes,
                                                    std::vector<std::size_t> loose, float gap) {
  std::vector<std::vector<std::size_t>> groups = {loose};
  std::stable_sort(loose.begin(), loose.end(), [&](std::size_t a, std::size_t b) {
    return nodes.points[a].norm() < nodes.points[b].norm();
  });
  float last = 0.0F;
  for (const std::size_t i : loose) {
    const float range = nodes.points[i].norm();
    if (groups.size() == 1 || range - last > gap) groups.emplace_back();
    groups.back().push_back(i);
    last = range;
  }
  return groups;
}

/// The three steps, each on the nodes the one before left open.
class PartFinder {
 public:
  PartFinder(const Nodes& nodes, const std::vector<Instance>& instances, const FusionConfig& config)
      : nodes_(nodes), instances_(instances), config_(config), open_(nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) open_[i] = nodes.on_plane[i] == 0;
  }

  DynamicParts run() {
    const Clusters coarse = cluster_nodes(nodes_, open_, Gap::kCoarse, config_);
    find_loose(coarse);
    if (nodes_.width == 0) take_sparse_objects();
    step(coarse, [&](std::size_t, const ClusterVote& vote, const DynamicPart&) {
      return is_labelled(vote) ? Verdict::kDynamic : Verdict::kMixed;
    });
    step(cluster_nodes(nodes_, open_, Gap::kFine, config_),
         [&](std::size_t, const ClusterVote& vote, const DynamicPart& part) {
           const bool is_dynamic = is_labelled(vote) || is_partial_object(vote, part);
           return is_dynamic ? Verdict::kDynamic : Verdict::kMixed;
         });
    const std::vector<std::uint8_t> source = open_;
    for (std::size_t i = 0; i < nodes_.size(); ++i) open_[i] = open_[i] != 0 && nodes_.raw[i] != 0;
    const Clusters pieces = cluster_nodes(nodes_, open_, Gap::kFine, config_);
    const auto contacts = count_contacts(nodes_, pieces, source, Gap::kFine, config_);
    step(pieces, [&](std::size_t c, const ClusterVote& vote, const DynamicPart&) {
      return is_own(vote, contacts[c]) ? Verdict::kDynamic : Verdict::kStatic;
    });
    return std::move(result_);
  }

 private:
  void find_loose(const Clusters& clusters) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const bool is_apart = clusters.label[i] == Clusters::kNone;
      if (open_[i] != 0 && nodes_.raw[i] != 0 && is_apart) result_.loose.push_back(i);
    }
  }

  /// Far away the rings of a scan are farther apart than a cluster's gap: the loose nodes under one
  /// mask are an object if they fit its size, or the nearest of them that do. The others are of the
  /// background, which a single node at the mask's boundary may hit.
  void take_sparse_objects() {
    std::vector<std::vector<std::size_t>> loose(instances_.size());
    for (const std::size_t i : result_.loose) loose[nodes_.raw[i] - std::size_t{1}].push_back(i);
    for (std::size_t k = 0; k < loose.size(); ++k) {
      const auto object_class = static_cast<std::size_t>(instances_[k].object_class);
      const ObjectSize& size = config_.sizes[object_class];
      const float gap = kSparseGap * static_cast<float>(size.width);
      for (std::vector<std::size_t>& group : sparse_groups(nodes_, std::move(loose[k]), gap)) {
        if (group.size() < kMinSparseNodes) continue;
        DynamicPart part;
        part.nodes = std::move(group);
        part.instance = static_cast<int>(k);
        part.is_sparse = true;
        part.box = box_of(nodes_, part);
        if (!fits(part.box, size)) continue;
        result_.parts.push_back(std::move(part));
        break;
      }
    }
  }

  /// Adds the dynamic clusters to the result and leaves the mixed ones open.
  template <class Judge>
  void step(const Clusters& clusters, const Judge& judge) {
    const auto votes = count_votes(nodes_, clusters, instances_.size());
    auto parts = collect(nodes_, clusters, votes);
    std::fill(open_.begin(), open_.end(), std::uint8_t{0});
    for (std::size_t c = 0; c < parts.size(); ++c) {
      if (parts[c].nodes.empty()) continue;
      const Verdict verdict = judge(c, votes[c], parts[c]);
      if (verdict == Verdict::kMixed) {
        for (const std::size_t i : parts[c].nodes) open_[i] = 1;
      } else if (verdict == Verdict::kDynamic) {
        for (DynamicPart& part : divide_part(nodes_, std::move(parts[c]), config_)) {
          part.box = box_of(nodes_, part);
          result_.parts.push_back(std::move(part));
        }
      }
    }
  }

  /// The 90 % rule; nodes that only the dilation covers belong to the background.
  bool is_labelled(const ClusterVote& vote) const {
    return vote.labelled >= config_.dynamic_share * vote.nodes &&
           vote.raw >= config_.partial_share * vote.nodes;
  }

  bool is_partial_object(const ClusterVote& vote, const DynamicPart& part) const {
    const auto object_class = instances_[static_cast<std::size_t>(vote.instance)].object_class;
    return vote.raw >= config_.partial_share * vote.nodes &&
           fits(box_of(nodes_, part), config_.sizes[static_cast<std::size_t>(object_class)]);
  }

  bool is_own(const ClusterVote& vote, int contacts) const {
    const bool is_apart = nodes_.width > 0 && contacts <= config_.contact_share * vote.nodes;
    return is_apart || vote.instance_share >= config_.instance_share;
  }

  const Nodes& nodes_;
  const std::vector<Instance>& instances_;
  const FusionConfig& config_;
  std::vector<std::uint8_t> open_;  ///< nodes still to be decided
  DynamicParts result_;
};

}  // namespace

bool fits(const Eigen::AlignedBox3f& box, const ObjectSize& size) {
  Eigen::Vector3f sides = box.sizes();
  std::sort(sides.begin(), sides.end());
  return sides[2] <= static_cast<float>(size.length) && sides[1] <= static_cast<float>(size.width);
}

DynamicParts find_dynamic_parts(const Nodes& nodes, const std::vector<Instance>& instances,
                                const FusionConfig& config) {
  return PartFinder(nodes, instances, config).run();
}

}  // namespace mms
