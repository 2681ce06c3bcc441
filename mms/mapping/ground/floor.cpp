#include "mms/mapping/ground/floor.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mms/mapping/ground/floor_patches.hpp"

namespace mms {
namespace {

using Patches = std::vector<FloorPatch>;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

const double kSameDirection = std::cos(radians(12.0));

/// The direction that most patches face, to within `kSameDirection`: floor, tables and shelves of
/// a room agree in it, whatever their heights.
Eigen::Vector3d common_direction(const Patches& patches) {
  constexpr std::size_t kCandidates = 64;
  constexpr int kRounds = 4;
  const std::size_t stride = std::max<std::size_t>(1, patches.size() / kCandidates);
  const auto mean_around = [&](const Eigen::Vector3d& direction) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const FloorPatch& patch : patches) {
      if (patch.normal.dot(direction) >= kSameDirection) sum += patch.normal;
    }
    return sum;
  };
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < patches.size(); i += stride) {
    const Eigen::Vector3d sum = mean_around(patches[i].normal);
    if (sum.squaredNorm() > best.squaredNorm()) best = sum;
  }
  for (int round = 0; round < kRounds; ++round) best = mean_around(best.normalized());
  return best.normalized();
}

/// Height of the lowest peak in the histogram of the patches' heights along `up` that has enough
/// area, both in itself and beside the largest.
std::optional<double> lowest_level(const Patches& patches, const Eigen::Vector3d& up,
                                   double min_area) {
  constexpr double kBin = 0.05;         // [m]
  constexpr double kLeastShare = 0.15;  // of the largest level's area
  constexpr double kTallest = 1000.0;   // [m]
  std::vector<double> heights;
  for (const FloorPatch& patch : patches) {
    if (patch.normal.dot(up) >= kSameDirection) heights.push_back(up.dot(patch.mean));
  }
  if (heights.empty()) return std::nullopt;
  const double lowest = *std::min_element(heights.begin(), heights.end());
  const double highest = *std::max_element(heights.begin(), heights.end());
  const double range = std::min(highest - lowest, kTallest);
  std::vector<double> area(static_cast<std::size_t>(range / kBin) + 3);
  for (const double height : heights) {
    const auto bin = static_cast<std::size_t>(std::min(height - lowest, range) / kBin);
    for (std::size_t i = bin; i < bin + 3; ++i) area[i] += kPatchSize * kPatchSize;
  }
  const double largest = *std::max_element(area.begin(), area.end());
  const double needed = std::max(min_area, kLeastShare * largest);
  std::size_t bin = 0;
  while (bin < area.size() && area[bin] < needed) ++bin;
  if (bin == area.size()) return std::nullopt;
  while (bin + 1 < area.size() && area[bin + 1] > area[bin]) ++bin;
  return lowest + kBin * (static_cast<double>(bin) - 0.5);
}

/// The plane of least squares through the patches within `tolerance` [m] of `floor`.
Floor refined(const Patches& patches, const Floor& floor, double tolerance) {
  constexpr double kLeastWidth = 0.3;  // of what can turn the plane: a standard deviation [m]
  Patches level;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const FloorPatch& patch : patches) {
    if (patch.normal.dot(floor.up) < kSameDirection) continue;
    if (std::abs(floor.up.dot(patch.mean) - floor.height) > tolerance) continue;
    level.push_back(patch);
    mean += patch.mean;
  }
  if (level.empty()) return floor;
  mean /= static_cast<double>(level.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const FloorPatch& patch : level) {
    covariance += (patch.mean - mean) * (patch.mean - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance /
                                                              static_cast<double>(level.size()));
  Floor result = floor;
  if (solver.eigenvalues()(1) > kLeastWidth * kLeastWidth) {
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    result.up = normal.dot(floor.up) < 0.0 ? Eigen::Vector3d(-normal) : normal;
  }
  result.height = result.up.dot(mean);
  return result;
}

/// Level, at the height that few points are below.
Floor guessed(const MapCloud& map, const Eigen::Vector3d& up) {
  constexpr std::size_t kShareBelow = 50;  // one in so many points
  std::vector<double> heights;
  for (const Eigen::Vector3f& point : map.points) {
    if (point.allFinite()) heights.push_back(up.dot(point.cast<double>()));
  }
  if (heights.empty()) return {up, 0.0, false};
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / kShareBelow);
  std::nth_element(heights.begin(), low, heights.end());
  return {up, *low, false};
}

}  // namespace

Floor find_floor(const MapCloud& map, const Eigen::Vector3d& up, const FloorConfig& config) {
  const double min_cosine = std::cos(radians(config.max_tilt));
  const Patches patches = floor_patches(map, up, min_cosine);
  if (patches.empty()) return guessed(map, up);
  const Eigen::Vector3d direction = common_direction(patches);
  const std::optional<double> height = lowest_level(patches, direction, config.min_area);
  if (!height) return guessed(map, up);
  Floor floor{direction, *height, true};
  for (const double tolerance : {0.2, 0.1, 0.1, 0.05, 0.05}) {
    floor = refined(patches, floor, tolerance);
  }
  return floor.up.dot(up) >= min_cosine ? floor : guessed(map, up);
}

Transform<World, Map> map_frame(const Floor& floor, const Eigen::Vector3d& forward) {
  constexpr double kLeast = 0.1;  // a sensor that looks up or down has no forward
  const Eigen::Vector3d level = forward - floor.up.dot(forward) * floor.up;
  const Eigen::Vector3d x = level.norm() > kLeast ? level.normalized() : floor.up.unitOrthogonal();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << x, floor.up.cross(x), floor.up;
  T.translation() = floor.height * floor.up;
  return Transform<World, Map>(T);
}

}  // namespace mms
