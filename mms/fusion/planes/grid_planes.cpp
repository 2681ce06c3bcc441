#include "mms/fusion/planes/grid_planes.hpp"

#include <algorithm>
#include <cmath>

#include "mms/fusion/planes/static_planes.hpp"
#include "mms/geometry/normals.hpp"

namespace mms {
namespace {

/// [nodes]: half the baseline of the normals, and the margin of `GridPlanes::seen`, for within this
/// distance of an edge a plane has no normal.
/// Source: initial choice; 6 nodes are 9 cm at 2 m (stride 2, focal length 525 px).
constexpr int kReach = 3;

/// [nodes]: spacing of the votes for planes. Source: computing time; half the normals' baseline.
constexpr int kSampleStride = 3;

/// [m]: depth by which a node may be off the line through its neighbors to have a normal.
/// Source: initial choice; depth noise at grazing incidence must pass, outliers of the normal are
/// rejected by the votes.
constexpr float kMaxStep = 0.5F;

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

/// The connected pieces of one plane.
class PlanePieces {
 public:
  PlanePieces(const Nodes& nodes, std::vector<std::uint8_t>& marks)
      : nodes_(nodes), marks_(marks) {}

  /// Removes the pieces of plane `bit` that masks cover by more than `max_masked_share`: the flat
  /// side of a vehicle in line with a rack is no part of the rack.
  void drop_masked(std::uint8_t bit, double max_masked_share) {
    std::vector<std::uint8_t> open(marks_.size());
    for (std::size_t i = 0; i < marks_.size(); ++i) open[i] = marks_[i] & bit;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (open[i] == 0) continue;
      const std::vector<std::size_t> piece = take_piece(i, open);
      const auto masked = std::count_if(piece.begin(), piece.end(),
                                        [&](std::size_t n) { return nodes_.raw[n] != 0; });
      if (static_cast<double>(masked) <= max_masked_share * static_cast<double>(piece.size()))
        continue;
      for (const std::size_t n : piece) marks_[n] &= static_cast<std::uint8_t>(~bit);
    }
  }

 private:
  /// The nodes joined to `first`, which are no longer open.
  std::vector<std::size_t> take_piece(std::size_t first, std::vector<std::uint8_t>& open) const {
    const auto width = static_cast<std::size_t>(nodes_.width);
    std::vector<std::size_t> piece{first};
    const auto take = [&](std::size_t n) {
      if (open[n] != 0) piece.push_back(n);
      open[n] = 0;
    };
    open[first] = 0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const std::size_t n = piece[k];
      if (n % width > 0) take(n - 1);
      if (n % width + 1 < width) take(n + 1);
      if (n >= width) take(n - width);
      if (n + width < open.size()) take(n + width);
    }
    return piece;
  }

  const Nodes& nodes_;
  std::vector<std::uint8_t>& marks_;
};

}  // namespace

GridPlanes find_grid_planes(const Nodes& nodes, const PlaneRemoval& config) {
  const int width = nodes.width;
  const int height = static_cast<int>(nodes.size()) / width;
  const auto patches = grid_patches(nodes.points, width, kReach, kMaxStep);
  GridPlanes result;
  result.planes = vote_planes(nodes, patches, config);
  result.seen = mark_planes(nodes, patches, result.planes, config);
  for (std::size_t k = 0; k < result.planes.size(); ++k) {
    const auto bit = static_cast<std::uint8_t>(1U << k);
    PlanePieces(nodes, result.seen).drop_masked(bit, config.max_masked_share);
  }
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
