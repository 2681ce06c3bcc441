#include "mms/mapping/motion_segmentation/image_nodes.hpp"

#include "mms/mapping/motion_segmentation/unknown_clusters.hpp"

namespace mms {
namespace {

/// [m]: gap in depth between neighbors of one component, before noise. Source: initial
/// choice, equal to `FusionConfig::cluster_tolerance`.
constexpr float kMaxGap = 0.1F;
/// [-]: sigmas of depth noise added to `kMaxGap`. Source: 95 % of the normal distribution.
constexpr float kGapSigmas = 2.0F;
/// [-]: share of the nodes around a core that are on no known surface. Source: by experiment
/// on the scenes crowd and still_walker.
constexpr double kMinOpenShare = 0.9;
/// [-]: share of the nodes around a core in free space. Source: as `kMinOpenShare`.
constexpr double kMinFreeShare = 0.3;
/// [-]: nodes of an object. Source: as `kMinOpenShare`.
constexpr std::size_t kMinNodes = 30;

}  // namespace

template <class Counts>
ImageNodes::StateCounts::StateCounts(const std::vector<SpaceState>& states, int width, int height,
                                     const Counts& counts)
    : sums_(width + 1, height + 1) {
  std::size_t node = 0;
  for (int y = 0; y < height; ++y) {
    int row = 0;
    for (int x = 0; x < width; ++x) {
      row += counts(states[node++]) ? 1 : 0;
      sums_(x + 1, y + 1) = sums_(x + 1, y) + row;
    }
  }
}

int ImageNodes::StateCounts::around(int x, int y, int radius) const {
  const int left = std::max(0, x - radius);
  const int top = std::max(0, y - radius);
  const int right = std::min(sums_.width() - 1, x + radius + 1);
  const int bottom = std::min(sums_.height() - 1, y + radius + 1);
  return sums_(right, bottom) - sums_(left, bottom) - sums_(right, top) + sums_(left, top);
}

ImageNodes::ImageNodes(const LabeledCloud& cloud, const DepthNoise& noise, double radius)
    : cloud_(cloud),
      noise_(noise),
      radius_(radius),
      width_(cloud.width / kStep),
      height_(cloud.height / kStep) {}

void ImageNodes::set_states(const std::vector<SpaceState>& states) {
  const auto counts_of = [&](const auto& counts) {
    return StateCounts(states, width_, height_, counts);
  };
  static_ = counts_of([](SpaceState state) { return state != SpaceState::kNone; });
  surface_ = counts_of([](SpaceState state) { return state == SpaceState::kSurface; });
  free_ = counts_of([](SpaceState state) { return state == SpaceState::kFree; });
}

float ImageNodes::max_gap(float depth) const {
  return kMaxGap + kGapSigmas * noise_.sigma(depth);
}

bool ImageNodes::is_core(std::size_t node, const std::vector<SpaceState>& states) const {
  if (states[node] != SpaceState::kFree) return false;
  const int x = column(node);
  const int y = row(node);
  const double pixels = radius_ * cloud_.camera.fx / depth(node);
  const int reach = std::clamp(static_cast<int>(std::lround(pixels / kStep)), 1, width_);
  const int side = 2 * reach + 1;
  const int all = static_.around(x, y, reach);
  if (2 * all < side * side) return false;
  return surface_.around(x, y, reach) <= (1.0 - kMinOpenShare) * all &&
         free_.around(x, y, reach) >= kMinFreeShare * all;
}

std::vector<std::size_t> ImageNodes::boundary_nodes(const std::vector<SpaceState>& states) const {
  std::vector<std::size_t> nodes;
  if (cloud_.clusters.empty()) return nodes;
  for (std::size_t node = 0; node < states.size(); ++node) {
    if (states[node] != SpaceState::kFree) continue;
    bool adjoins = false;
    for_each_adjoining_cluster(node, [&](int) { adjoins = true; });
    if (adjoins) nodes.push_back(node);
  }
  return nodes;
}

bool ImageNodes::is_object(const Component& component) const {
  return component.size() >= kMinNodes;
}

void ImageNodes::relabel(const Component& component, int cluster, LabeledCloud& cloud,
                         Image<std::uint8_t>& moved) const {
  for (const std::size_t node : component) {
    for (int y = kStep * row(node); y < kStep * (row(node) + 1); ++y) {
      for (int x = kStep * column(node); x < kStep * (column(node) + 1); ++x) {
        const std::size_t i = cloud.index(x, y);
        if (cloud.labels[i] != PointLabel::kStatic) continue;
        make_dynamic(i, cluster, cloud);
        cloud.dynamic_pixels[i] = 1;
        moved[i] = 1;
      }
    }
  }
}

}  // namespace mms
