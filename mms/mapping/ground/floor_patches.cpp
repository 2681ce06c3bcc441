#include "mms/mapping/ground/floor_patches.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <optional>

#include "mms/geometry/voxels/voxel_hash_map.hpp"

namespace mms {
namespace {

/// Sums over the map's points in one voxel, relative to its first one.
struct Sums {
  int count = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();  // zero where all are unknown

  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    if (count++ == 0) first = point;
    const Eigen::Vector3d offset = point - first;
    sum += offset;
    squares += offset * offset.transpose();
    normals += normal;
  }
};

/// The patch of a voxel's points; nothing where they are few, in a line, or not flat.
std::optional<FloorPatch> fit_patch(const Sums& sums, const Eigen::Vector3d& up) {
  constexpr int kFewest = 6;
  constexpr double kLeastWidth = 0.05;  // standard deviation along the shorter side [m]
  constexpr double kThickest = 0.3;     // standard deviation across it, relative to that
  if (sums.count < kFewest) return std::nullopt;
  const Eigen::Vector3d mean = sums.sum / sums.count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sums.squares / sums.count -
                                                              mean * mean.transpose());
  const Eigen::Vector3d variances = solver.eigenvalues();
  if (variances(1) < kLeastWidth * kLeastWidth) return std::nullopt;
  if (variances(0) > kThickest * kThickest * variances(1)) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return FloorPatch{sums.first + mean, normal.dot(up) < 0.0 ? Eigen::Vector3d(-normal) : normal};
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
