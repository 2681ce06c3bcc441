#include "mms/geometry/clustering.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "mms/geometry/union_find.hpp"
#include "mms/geometry/voxels/cell_chains.hpp"

namespace mms {
namespace {

struct Offset {
  int x;
  int y;
};

/// Half of the grid neighborhood: the cells before a point in row-major order.
constexpr std::array<Offset, 6> kBefore = {{{-1, 0}, {-2, 0}, {0, -1}, {0, -2}, {-1, -1}, {1, -1}}};

std::vector<std::uint8_t> usable(std::span<const Eigen::Vector3f> points,
                                 std::span<const std::uint8_t> keep) {
  std::vector<std::uint8_t> use(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) use[i] = keep[i] != 0 && points[i].allFinite();
  return use;
}

/// Numbers the sets of kept points of an allowed size.
Clusters number_sets(UnionFind& sets, const std::vector<std::uint8_t>& use,
                     const ClusterSize& size) {
  std::vector<int> members(use.size(), 0);
  for (std::size_t i = 0; i < use.size(); ++i) {
    if (use[i] != 0) ++members[sets.find(i)];
  }
  Clusters clusters;
  clusters.label.assign(use.size(), Clusters::kNone);
  for (std::size_t i = 0; i < use.size(); ++i) {
    if (use[i] == 0) continue;
    const std::size_t first = sets.find(i);
    if (members[first] < size.min_points || members[first] > size.max_points) continue;
    clusters.label[i] = first == i ? clusters.count++ : clusters.label[first];
  }
  return clusters;
}

}  // namespace

Clusters cluster_grid(std::span<const Eigen::Vector3f> points, int width,
                      std::span<const std::uint8_t> keep, std::span<const float> tolerance,
                      const ClusterSize& size) {
  const std::vector<std::uint8_t> use = usable(points, keep);
  UnionFind sets(points.size());
  const int height = width > 0 ? static_cast<int>(points.size()) / width : 0;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++i) {
      if (use[i] == 0) continue;
      std::size_t root = i;
      for (const Offset& offset : kBefore) {
        if (x + offset.x < 0 || x + offset.x >= width || y + offset.y < 0) continue;
        const auto j = static_cast<std::size_t>((y + offset.y) * width + x + offset.x);
        if (use[j] == 0) continue;
        const float limit = std::max(tolerance[i], tolerance[j]);
        const bool is_linked = (points[i] - points[j]).squaredNorm() <= limit * limit;
        if (is_linked) root = sets.unite(root, j);
      }
    }
  }
  return number_sets(sets, use, size);
}

Clusters cluster_points(std::span<const Eigen::Vector3f> points, std::span<const std::uint8_t> keep,
                        float tolerance, const ClusterSize& size) {
  const std::vector<std::uint8_t> use = usable(points, keep);
  UnionFind sets(points.size());
  CellChains cells(points.size(), tolerance);
  const float limit2 = tolerance * tolerance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (use[i] == 0) continue;
    cells.for_each_near(points[i], [&](std::size_t j) {
      if ((points[i] - points[j]).squaredNorm() <= limit2) sets.unite(i, j);
    });
    cells.insert(points[i], i);
  }
  return number_sets(sets, use, size);
}

}  // namespace mms
