#pragma once

#include <functional>
#include <vector>

#include "mms/simulation/models/mesh_shapes.hpp"

namespace mms {

/// Rings on smooth curves through `keys` (ascending z), about `step` [m] apart.
std::vector<Ring> smooth_rings(const std::vector<Ring>& keys, float step);

/// The rings with a half ellipsoid of `rows` more rings at both ends, so that two limbs at the same
/// joint stay closed at any angle.
std::vector<Ring> rounded_rings(const std::vector<Ring>& rings, int rows = 3);

/// All lengths of the rings scaled by `factor`.
std::vector<Ring> scaled_rings(std::vector<Ring> rings, float factor);

/// Material at height z [m] and angle about the z axis (0 in front, pi/2 left), in [0, 2 pi).
using Paint = std::function<std::uint32_t(float z, float angle)>;

/// A loft whose patches have the material that `paint` returns for their center.
void add_painted_loft(Mesh& mesh, const std::vector<Ring>& rings, const Paint& paint, int segments);

/// Rotation about an axis through the origin.
Eigen::Isometry3f turned(float angle, const Eigen::Vector3f& axis);

/// Rotates z to forward x and x to up z: lofts along x.
Eigen::Isometry3f lying();

}  // namespace mms
