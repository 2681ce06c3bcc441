#pragma once

#include <Eigen/Geometry>

#include "mms/core/random_stream.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Parts of a building. On walls, the origin of `T` is at the base of the wall, x along it and y
/// into the room [m].

/// A wall of `length` x `height` x 0.2 m with a dark plinth; its surface is the plane y = 0.
void add_wall(Mesh& mesh, const Eigen::Isometry3f& T, float length, float height,
              const Material& material);

/// A roller shutter of 3.2 x 3.2 m with hazard stripes at its sides.
void add_gate(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random);

/// A door of 1 x 2.1 m with handle and sign.
void add_door(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random);

/// A sign or poster of random size and colors, between 1.2 and 2.6 m high.
void add_sign(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random);

/// A steel column of `height` with a guard rail with hazard stripes, centered at the origin of `T`.
void add_column(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random);

/// A long lamp along x that hangs at the origin of `T`.
void add_lamp_body(Mesh& mesh, const Eigen::Isometry3f& T);

/// A painted strip on the floor, along x.
void add_marking(Mesh& mesh, const Eigen::Isometry3f& T, float length, float width,
                 const Material& paint);

/// A pipe or cable tray along x, centered at the origin of `T`.
void add_pipe(Mesh& mesh, const Eigen::Isometry3f& T, float length, float radius,
              RandomStream& random);

}  // namespace mms
