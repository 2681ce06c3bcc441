#include "mms/mapping/ground/floor_patches.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "mms/geometry/principal_axes.hpp"
#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {
namespace {

/// [-]: points of a patch. Source: twice the three of a plane.
constexpr int kMinPoints = 6;

/// [m]: standard deviation along a patch's shorter side. Source: less than half that of a full
/// patch, `kPatchSize` / sqrt(12).
constexpr double kMinWidth = 0.05;

/// [-]: standard deviation across a patch, relative to that along its shorter side. Source: 3.5 cm
/// in a full patch, about a LiDAR's noise.
constexpr double kMaxThickness = 0.3;

/// Sums over the map's points in one voxel, relative to its first one.
struct Sums {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  PointSums<double, 3> offsets;
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();  // zero where all are unknown

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    if (offsets.count() == 0) first = point;
    offsets.add(point - first);
    normals += normal;
  }
};

/// The patch of a voxel's points; nothing where they are too few, collinear or not flat.
std::optional<FloorPatch> fit_patch(const Sums& sums, const Eigen::Vector3d& up) {
  if (sums.offsets.count() < kMinPoints) return std::nullopt;
  const auto [variances, axes] = principal_axes(sums.offsets.covariance());
  if (variances(1) < kMinWidth * kMinWidth) return std::nullopt;
  if (variances(0) > kMaxThickness * kMaxThickness * variances(1)) return std::nullopt;
  const Eigen::Vector3d normal = axes.col(0);
  return FloorPatch{sums.first + sums.offsets.mean(), oriented(normal, up)};
}

}  // namespace

std::vector<FloorPatch> floor_patches(const MapCloud& map, const Eigen::Vector3d& up,
                                      double min_cosine) {
  VoxelHashMap<Sums> cells(kPatchSize, std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!map.points[i].allFinite()) continue;
    cells.touch(cells.key(map.points[i]))
        .add(map.points[i].cast<double>(), map.normals[i].cast<double>());
  }
  std::vector<FloorPatch> patches;
  for (const auto& entry : cells.entries()) {
    const std::optional<FloorPatch> patch = fit_patch(entry.cell, up);
    if (!patch || patch->normal.dot(up) < min_cosine) continue;
    if (patch->normal.dot(entry.cell.normals) >= 0.0) patches.push_back(*patch);
  }
  return patches;
}

}  // namespace mms
