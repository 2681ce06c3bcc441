#include "mms/mapping/ground/floor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mms/geometry/principal_axes.hpp"
#include "mms/mapping/ground/floor_patches.hpp"

namespace mms {
namespace {

using Patches = std::vector<FloorPatch>;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// [-]: cosine of the angle between the normals of parallel patches. Source: 12 degrees, three
/// standard deviations of the tilt of a patch of six points with noise of 2 cm.
const double kMinParallelCosine = std::cos(radians(12.0));

/// [-]: directions tested. Source: bounds the time, which is their number times the patches.
constexpr std::size_t kMaxCandidates = 64;

/// [-]: rounds of mean shift. Source: bounds the time; the set of patches settles in a few.
constexpr int kMeanShiftRounds = 4;

/// [m]: bin of the histogram of heights. Source: each patch counts in three, which are lower
/// together than a step of 0.17 m.
constexpr double kHeightBin = 0.05;

/// [-]: least area of a floor, relative to the largest level. Source: by experiment on the
/// simulated scenes; a table or shelf top seen from close is larger than the floor around it.
constexpr double kMinAreaShare = 0.15;

/// [m]: range of heights of a histogram. Source: bounds its memory.
constexpr double kMaxHeightRange = 1000.0;

/// [m]: least width of a floor that determines the direction of up, as a standard deviation.
/// Source: noise of 1 cm then tilts it by less than two degrees.
constexpr double kMinFloorWidth = 0.3;

/// [m]: distances to the plane, round by round, within which patches are fitted. Source: the first
/// covers a tilt of two degrees at 6 m, the last three standard deviations of noise of 1.7 cm.
constexpr std::array<double, 5> kTolerances = {0.2, 0.1, 0.1, 0.05, 0.05};

/// [-]: share of points below an assumed floor, as one in so many. Source: stray points of
/// reflexes.
constexpr std::size_t kPointsPerPointBelow = 50;

/// [-]: least length of the horizontal part of `forward`. Source: six degrees from the vertical.
constexpr double kMinForward = 0.1;

/// The normal of most patches, within `kMinParallelCosine`: floor, tables and shelves of a room are
/// parallel at all heights.
Eigen::Vector3d common_direction(const Patches& patches) {
  const std::size_t stride = std::max<std::size_t>(1, patches.size() / kMaxCandidates);
  const auto mean_around = [&](const Eigen::Vector3d& direction) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const FloorPatch& patch : patches) {
      if (patch.normal.dot(direction) >= kMinParallelCosine) sum += patch.normal;
    }
    return sum;
  };
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < patches.size(); i += stride) {
    const Eigen::Vector3d sum = mean_around(patches[i].normal);
    if (sum.squaredNorm() > best.squaredNorm()) best = sum;
  }
  for (int round = 0; round < kMeanShiftRounds; ++round) best = mean_around(best.normalized());
  return best.normalized();
}

/// Height of the lowest peak in the histogram of the patches' heights along `up` that has enough
/// area, both absolute and relative to the largest.
std::optional<double> lowest_level(const Patches& patches, const Eigen::Vector3d& up,
                                   double min_area) {
  std::vector<double> heights;
  for (const FloorPatch& patch : patches) {
    if (patch.normal.dot(up) >= kMinParallelCosine) heights.push_back(up.dot(patch.mean));
  }
  if (heights.empty()) return std::nullopt;
  const double lowest = *std::min_element(heights.begin(), heights.end());
  const double highest = *std::max_element(heights.begin(), heights.end());
  const double range = std::min(highest - lowest, kMaxHeightRange);
  std::vector<double> area(static_cast<std::size_t>(range / kHeightBin) + 3);
  for (const double height : heights) {
    const auto bin = static_cast<std::size_t>(std::min(height - lowest, range) / kHeightBin);
    for (std::size_t i = bin; i < bin + 3; ++i) area[i] += kPatchSize * kPatchSize;
  }
  const double largest = *std::max_element(area.begin(), area.end());
  const double needed = std::max(min_area, kMinAreaShare * largest);
  std::size_t bin = 0;
  while (bin < area.size() && area[bin] < needed) ++bin;
  if (bin == area.size()) return std::nullopt;
  while (bin + 1 < area.size() && area[bin + 1] > area[bin]) ++bin;
  return lowest + kHeightBin * (static_cast<double>(bin) - 0.5);
}

/// The plane of least squares through the patches within `tolerance` [m] of `floor`.
Floor refined(const Patches& patches, const Floor& floor, double tolerance) {
  Patches level;
  for (const FloorPatch& patch : patches) {
    if (patch.normal.dot(floor.up) < kMinParallelCosine) continue;
    if (std::abs(floor.up.dot(patch.mean) - floor.height) > tolerance) continue;
    level.push_back(patch);
  }
  if (level.empty()) return floor;
  const auto scatter = scatter_of(level, &FloorPatch::mean);
  const Eigen::Matrix3d covariance = scatter.matrix / static_cast<double>(level.size());
  const auto axes = principal_axes(covariance);
  Floor result = floor;
  if (axes.variances(1) > kMinFloorWidth * kMinFloorWidth) {
    result.up = oriented(axes.smallest(), floor.up);
  }
  result.height = result.up.dot(scatter.mean);
  return result;
}

/// Level, at a low quantile of the points' heights.
Floor assumed_floor(const MapCloud& map, const Eigen::Vector3d& up) {
  std::vector<double> heights;
  for (const Eigen::Vector3f& point : map.points) {
    if (point.allFinite()) heights.push_back(up.dot(point.cast<double>()));
  }
  if (heights.empty()) return {up, 0.0, false};
  const auto low =
      heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / kPointsPerPointBelow);
  std::nth_element(heights.begin(), low, heights.end());
  return {up, *low, false};
}

}  // namespace

Floor find_floor(const MapCloud& map, const Eigen::Vector3d& up, const FloorConfig& config) {
  const double min_cosine = std::cos(radians(config.max_tilt));
  const Patches patches = floor_patches(map, up, min_cosine);
  if (patches.empty()) return assumed_floor(map, up);
  const Eigen::Vector3d direction = common_direction(patches);
  const std::optional<double> height = lowest_level(patches, direction, config.min_area);
  if (!height) return assumed_floor(map, up);
  Floor floor{direction, *height, true};
  for (const double tolerance : kTolerances) {
    floor = refined(patches, floor, tolerance);
  }
  return floor.up.dot(up) >= min_cosine ? floor : assumed_floor(map, up);
}

Transform<World, Map> map_frame(const Floor& floor, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d level = forward - floor.up.dot(forward) * floor.up;
  const Eigen::Vector3d x =
      level.norm() > kMinForward ? level.normalized() : floor.up.unitOrthogonal();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << x, floor.up.cross(x), floor.up;
  T.translation() = floor.height * floor.up;
  return Transform<World, Map>(T);
}

}  // namespace mms
