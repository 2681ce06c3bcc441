#pragma once

#include <Eigen/Geometry>

#include "mms/simulation/models/mesh.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// Points on all triangles, on a grid so fine that no place of the surface is farther than
/// `spacing` [m] from one, with normals and colours, label 0. `T` takes the mesh's frame to the
/// cloud's.
TruthCloud sample(const Mesh& mesh, const Eigen::Isometry3d& T, double spacing);

}  // namespace mms
