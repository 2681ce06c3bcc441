#include "mms/localization/features/organised_features.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mms/geometry/parallel.hpp"
#include "mms/localization/features/local_surface.hpp"

namespace mms {
namespace {

/// [px]: half width of the neighborhood of eq. (2).
/// Source: a right-angled edge then has a mean offset of 2.5 px, at a focal length of 262 px (a
/// Kinect's at half resolution) 0.0095 of the range: twice `edge_smoothness`.
constexpr int kSmoothnessWindow = 4;

/// [px]: spacing of its pixels. Source: computing time; 24 neighbors in place of 80.
constexpr int kSmoothnessStep = 2;

/// [-]: valid neighbors that eq. (2) requires, of 24.
/// Source: at a border a whole side of five is missing; depth cameras lose single pixels on dark
/// or slanted surfaces.
constexpr int kMinNeighbors = 20;

/// [px]: half width of the plane fit's neighborhood. Source: as kSmoothnessWindow.
constexpr int kPlaneWindow = 4;

/// [-]: points of the smallest plane fit, of 81.
/// Source: more than the 25 of one quadrant, so that they lie on more than one side.
constexpr int kMinPlanePoints = 30;

/// [px]: spacing of the candidates in a sector. Source: computing time; the default sector of 8 px
/// has 16 for three features.
constexpr int kCandidateStep = 2;

/// [px]: pixels of an image below which its sectors have half the side. Source: 224x168 works with
/// sectors of 8 px; the 300 sectors of 160x120 are too few for a first frame.
constexpr int kSmallImage = 32'000;

/// [-]: depth over lateral offset of the steepest surface, 63 degrees from frontal.
/// Source: initial choice, not tuned since.
constexpr float kMaxSlope = 2.0F;

/// [-]: depth noise between points of one surface, in sigmas. Source: three-sigma rule.
constexpr float kDepthSigmas = 3.0F;

/// [-]: largest rms distance from a fitted plane, in sigmas of the depth noise.
/// Source: noise alone stays below 1.4 for 30 points (chi square, 99.9 %); curvature has the rest.
constexpr float kMaxThickness = 2.0F;

/// [-]: smallest smoothness of an edge, in sigmas of the depth noise over the range.
/// Source: two-sigma rule; the noise of the point itself dominates the mean of eq. (2).
constexpr float kEdgeSigmas = 2.0F;

struct Candidate {
  int x;
  int y;
  float smoothness;  ///< magnitude of eq. (2) over range
  bool complete;     ///< no neighbor is missing, so it is not at a border
};

/// Reads the static points of an organised cloud by pixel.
class StaticGrid {
 public:
  StaticGrid(const LabeledCloud& cloud, const FeatureConfig& config)
      : cloud_(cloud), noise_(config.noise.depth) {}

  int width() const { return cloud_.width; }
  int height() const { return cloud_.height; }

  /// The static point at a pixel, or null.
  const Eigen::Vector3f* at(int x, int y) const {
    return label(x, y) == PointLabel::kStatic ? &cloud_.points[cloud_.index(x, y)] : nullptr;
  }

  /// Label of a pixel; invalid outside the image.
  PointLabel label(int x, int y) const {
    const bool inside = x >= 0 && y >= 0 && x < cloud_.width && y < cloud_.height;
    return inside ? cloud_.labels[cloud_.index(x, y)] : PointLabel::kInvalid;
  }

  /// Largest difference in depth [m] between points of one surface `pixels` apart.
  float depth_gate(float depth, int pixels) const {
    const float spacing = depth / static_cast<float>(cloud_.camera.fx);
    return kDepthSigmas * noise_.sigma(depth) + kMaxSlope * spacing * static_cast<float>(pixels);
  }

 private:
  const LabeledCloud& cloud_;
  DepthNoise noise_;
};

/// The pixel as a candidate; nothing where a neighbor is dynamic or on another surface, or fewer
/// than kMinNeighbors are valid: at the borders of occlusions, frame and dynamic regions.
std::optional<Candidate> candidate_at(const StaticGrid& grid, int x, int y) {
  constexpr int kSide = 2 * kSmoothnessWindow / kSmoothnessStep + 1;
  constexpr int kNeighbors = kSide * kSide - 1;
  const Eigen::Vector3f* centre = grid.at(x, y);
  if (centre == nullptr) return std::nullopt;
  const float range = centre->norm();
  const float gate = grid.depth_gate(centre->z(), kSmoothnessWindow);
  float sum = 0.0F;
  int count = 0;
  for (int dy = -kSmoothnessWindow; dy <= kSmoothnessWindow; dy += kSmoothnessStep) {
    for (int dx = -kSmoothnessWindow; dx <= kSmoothnessWindow; dx += kSmoothnessStep) {
      if (dx == 0 && dy == 0) continue;
      const Eigen::Vector3f* p = grid.at(x + dx, y + dy);
      if (p == nullptr) {
        if (grid.label(x + dx, y + dy) == PointLabel::kDynamic) return std::nullopt;
        continue;
      }
      if (std::abs(p->z() - centre->z()) > gate) return std::nullopt;
      sum += range - p->norm();
      ++count;
    }
  }
  if (count < kMinNeighbors) return std::nullopt;
  return Candidate{x, y, std::abs(sum / static_cast<float>(count)) / range, count == kNeighbors};
}

std::optional<PlaneFeature> fit_plane(const StaticGrid& grid, const Candidate& candidate,
                                      const FeatureConfig& config) {
  const Eigen::Vector3f& centre = *grid.at(candidate.x, candidate.y);
  const float gate = grid.depth_gate(centre.z(), kPlaneWindow);
  PlaneFit fit(centre);
  for (int dy = -kPlaneWindow; dy <= kPlaneWindow; ++dy) {
    for (int dx = -kPlaneWindow; dx <= kPlaneWindow; ++dx) {
      const Eigen::Vector3f* p = grid.at(candidate.x + dx, candidate.y + dy);
      if (p != nullptr && std::abs(p->z() - centre.z()) <= gate) fit.add(*p);
    }
  }
  if (fit.count() < kMinPlanePoints) return std::nullopt;
  const PlaneFit::Plane plane = fit.solve();
  const float noise = config.noise.depth.sigma(centre.z());
  const Eigen::Vector3f ray = centre / centre.z();
  const float incidence = plane.normal.dot(ray);
  if (plane.thickness > kMaxThickness * noise) return std::nullopt;
  if (-incidence < static_cast<float>(config.min_incidence) * ray.norm()) return std::nullopt;
  // The fitted plane's point on the ray averages the neighborhood's noise.
  return PlaneFeature{ray * (plane.normal.dot(plane.mean) / incidence), plane.normal, noise};
}

struct SectorFeatures {
  std::vector<EdgeFeature> edges;
  std::vector<PlaneFeature> planes;
};

/// Takes edges from the large end of the candidates sorted by smoothness, planes from the small.
SectorFeatures choose(const StaticGrid& grid, const std::vector<Candidate>& sorted,
                      const FeatureConfig& config) {
  SectorFeatures chosen;
  for (const Candidate& c : sorted) {
    if (static_cast<int>(chosen.planes.size()) >= config.planes_per_sector) break;
    if (c.smoothness > static_cast<float>(config.plane_smoothness)) break;
    if (const auto plane = fit_plane(grid, c, config)) chosen.planes.push_back(*plane);
  }
  for (auto c = sorted.rbegin(); c != sorted.rend(); ++c) {
    if (static_cast<int>(chosen.edges.size()) >= config.edges_per_sector) break;
    if (!c->complete) continue;
    const Eigen::Vector3f& point = *grid.at(c->x, c->y);
    const float sigma = config.noise.depth.sigma(point.z());
    const float least =
        std::max(static_cast<float>(config.edge_smoothness), kEdgeSigmas * sigma / point.norm());
    if (c->smoothness < least) break;
    chosen.edges.push_back({point, sigma});
  }
  return chosen;
}

std::vector<Candidate> sector_candidates(const StaticGrid& grid, int left, int top, int side) {
  std::vector<Candidate> candidates;
  for (int y = top; y < std::min(top + side, grid.height()); y += kCandidateStep) {
    for (int x = left; x < std::min(left + side, grid.width()); x += kCandidateStep) {
      if (const auto candidate = candidate_at(grid, x, y)) candidates.push_back(*candidate);
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.smoothness < b.smoothness; });
  return candidates;
}

/// The image in squares.
struct Sectors {
  int side;  ///< [px]
  std::size_t columns;
  std::size_t rows;

  std::size_t count() const { return columns * rows; }
};

Sectors sectors_of(const LabeledCloud& cloud, const FeatureConfig& config) {
  const bool is_small = cloud.width * cloud.height < kSmallImage;
  const int side = is_small ? config.sector_px / 2 : config.sector_px;
  return {side, static_cast<std::size_t>((cloud.width + side - 1) / side),
          static_cast<std::size_t>((cloud.height + side - 1) / side)};
}

}  // namespace

void extract_organised_features(const LabeledCloud& cloud, const FeatureConfig& config,
                                FeatureCloud& features) {
  const StaticGrid grid(cloud, config);
  const Sectors image = sectors_of(cloud, config);
  std::vector<SectorFeatures> sectors(image.count());
  parallel_chunks(image.rows, 1, [&](std::size_t row, std::size_t) {
    for (std::size_t column = 0; column < image.columns; ++column) {
      const int left = static_cast<int>(column) * image.side;
      const int top = static_cast<int>(row) * image.side;
      sectors[row * image.columns + column] =
          choose(grid, sector_candidates(grid, left, top, image.side), config);
    }
  });
  for (const SectorFeatures& sector : sectors) {
    features.edges.insert(features.edges.end(), sector.edges.begin(), sector.edges.end());
    features.planes.insert(features.planes.end(), sector.planes.begin(), sector.planes.end());
  }
}

}  // namespace mms
