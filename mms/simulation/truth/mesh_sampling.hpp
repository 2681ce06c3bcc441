#pragma once

#include <Eigen/Geometry>

#include "mms/simulation/models/mesh.hpp"
#include "mms/simulation/truth/truth_cloud.hpp"

namespace mms {

/// Points on all triangles, on a grid with a largest distance of `spacing` [m], with normals and
/// colors, label 0. `T` is the transform from the mesh's frame to the cloud's.
TruthCloud sample(const Mesh& mesh, const Eigen::Isometry3d& T, double spacing);

}  // namespace mms
