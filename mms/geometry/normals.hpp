#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mms {

/// Surface element around a point of an organized cloud.
struct SurfacePatch {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the origin; zero if unknown
  float area = 0.0F;                                 ///< of one grid cell [m^2]
};

/// Surface elements of an organized cloud (row-major, `width` columns) by central differences over
/// `step` cells; unknown if a neighbor is missing or deviates by more than `max_edge` [m] from
/// linear depth.
std::vector<SurfacePatch> grid_patches(std::span<const Eigen::Vector3f> points, int width, int step,
                                       float max_edge);

/// Normals (unit, towards the origin) of every `stride`-th point of an unorganized cloud, by PCA of
/// the points within `radius` [m]; zero for all other points and if there are too few points or no
/// flat surface.
std::vector<Eigen::Vector3f> neighbourhood_normals(std::span<const Eigen::Vector3f> points,
                                                   std::size_t stride, float radius);

}  // namespace mms
