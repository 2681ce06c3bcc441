#pragma once

#include <Eigen/Geometry>
#include <span>

#include "mms/core/random_stream.hpp"
#include "mms/simulation/models/mesh.hpp"

namespace mms {

/// Goods and furniture of a warehouse. The origin of `T` is the center of the base on the floor, z
/// up, x along the length [m].

/// A wooden pallet of 1.2 x 0.8 x 0.14 m.
void add_pallet(Mesh& mesh, const Eigen::Isometry3f& T, RandomStream& random);

/// A cardboard box of the given size.
void add_carton(Mesh& mesh, const Eigen::Isometry3f& T, const Eigen::Vector3f& size,
                RandomStream& random);

/// A pallet loaded with cartons, sacks, drums or a crate, up to `height` above the floor.
void add_loaded_pallet(Mesh& mesh, const Eigen::Isometry3f& T, float height, RandomStream& random);

/// A storage rack of `bays` x 2.7 m, 1.1 m deep, its long side along x, with loads on `levels`.
/// With `equal_loads` all bays are identical.
/// @param changes  each decides which loads are gone or others; `random` is used as without
void add_rack(Mesh& mesh, const Eigen::Isometry3f& T, int bays, int levels, bool equal_loads,
              RandomStream& random, std::span<RandomStream> changes = {});

inline constexpr float kBayLength = 2.7F;  ///< [m]
inline constexpr float kRackDepth = 1.1F;  ///< [m]

}  // namespace mms
