#include "mms/fusion/grid_planes.hpp"

#include <algorithm>
#include <cmath>

#include "mms/fusion/static_planes.hpp"
#include "mms/geometry/normals.hpp"

namespace mms {
namespace {

/// Half the baseline of the normals, and the reach of `GridPlanes::seen` [nodes]: where a normal is
/// spoilt by an edge, the plane is still seen.
constexpr int kReach = 3;
/// Nodes a side that share one vote in the search for planes.
constexpr int kSampleStride = 3;
/// Depth step that no surface a normal is taken of has [m].
constexpr float kMaxEdge = 0.5F;

PlaneSample sample_of(const Nodes& nodes, const SurfacePatch& patch, std::size_t i,
                      const PlaneRemoval& config) {
  constexpr float kShared = kSampleStride * kSampleStride;
  return {nodes.points[i], patch.normal, patch.area * kShared,
          config.distance_limit(nodes.sigma[i])};
}

std::vector<Plane> vote_planes(const Nodes& nodes, const std::vector<SurfacePatch>& patches,
                               const PlaneRemoval& config) {
  const int height = static_cast<int>(nodes.size()) / nodes.width;
  std::vector<PlaneSample> samples;
  std::vector<std::uint8_t> masked;
  for (int y = 1; y < height; y += kSampleStride) {
    for (int x = 1; x < nodes.width; x += kSampleStride) {
      const auto i = static_cast<std::size_t>(y * nodes.width + x);
      if (patches[i].normal.isZero(0.0F)) continue;
      samples.push_back(sample_of(nodes, patches[i], i, config));
      masked.push_back(nodes.raw[i] != 0);
    }
  }
  return find_static_planes(samples, masked, config);
}

/// Bit k set at the nodes that lie on plane k and face like it.
std::vector<std::uint8_t> mark_planes(const Nodes& nodes, const std::vector<SurfacePatch>& patches,
                                      const std::vector<Plane>& planes,
                                      const PlaneRemoval& config) {
  const float min_cosine = static_cast<float>(std::cos(config.max_normal_angle));
  std::vector<std::uint8_t> marks(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (patches[i].normal.isZero(0.0F)) continue;
    const PlaneSample sample = sample_of(nodes, patches[i], i, config);
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const bool is_on = is_on_plane(sample, planes[k], min_cosine);
      marks[i] |= static_cast<std::uint8_t>((is_on ? 1U : 0U) << k);
    }
  }
  return marks;
}

/// Every bit set within `reach` along each row (`stride` 1) or column (`stride` width).
std::vector<std::uint8_t> spread(const std::vector<std::uint8_t>& bits, int lines, int length,
                                 int line_stride, int stride, int reach) {
  std::vector<std::uint8_t> result(bits.size(), 0);
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < length; ++i) {
      const auto value = bits[static_cast<std::size_t>(line * line_stride + i * stride)];
      if (value == 0) continue;
      for (int k = std::max(0, i - reach); k <= std::min(length - 1, i + reach); ++k) {
        result[static_cast<std::size_t>(line * line_stride + k * stride)] |= value;
      }
    }
  }
  return result;
}

}  // namespace

GridPlanes find_grid_planes(const Nodes& nodes, const PlaneRemoval& config) {
  const int width = nodes.width;
  const int height = static_cast<int>(nodes.size()) / width;
  const auto patches = grid_patches(nodes.points, width, kReach, kMaxEdge);
  GridPlanes result;
  result.planes = vote_planes(nodes, patches, config);
  result.seen = mark_planes(nodes, patches, result.planes, config);
  result.seen = spread(result.seen, height, width, width, 1, kReach);
  result.seen = spread(result.seen, width, height, 1, width, kReach);
  return result;
}

bool is_on_plane(const GridPlanes& planes, std::size_t node, const Eigen::Vector3f& point,
                 float tolerance) {
  for (std::size_t k = 0; k < planes.planes.size(); ++k) {
    const bool is_seen = ((planes.seen[node] >> k) & 1U) != 0;
    if (is_seen && planes.planes[k].distance(point) <= tolerance) return true;
  }
  return false;
}

}  // namespace mms
