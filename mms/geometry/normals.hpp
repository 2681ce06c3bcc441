#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mms {

/// Piece of surface around a point of an organised cloud.
struct SurfacePatch {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the origin; zero if unknown
  float area = 0.0F;                                 ///< of one grid cell [m^2]
};

/// Patches of an organised cloud (row-major, `width` columns) by central differences over `step`
/// cells; unknown where a neighbour is missing or off the line of depth by more than `max_edge`
/// [m].
std::vector<SurfacePatch> grid_patches(std::span<const Eigen::Vector3f> points, int width, int step,
                                       float max_edge);

/// Normals (unit, towards the origin) of every `stride`-th point of an unorganised cloud, from the
/// principal axes of the points within `radius` [m]; zero for the others and where there are too
/// few points or no flat surface.
std::vector<Eigen::Vector3f> neighbourhood_normals(std::span<const Eigen::Vector3f> points,
                                                   std::size_t stride, float radius);

}  // namespace mms
