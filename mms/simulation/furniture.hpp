#pragma once

#include <cstdint>
#include <vector>

#include "mms/simulation/solid.hpp"

namespace mms {

/// Everything that stands still: a room of 6 x 5 x 3 m with posters, shelves, a table, a cabinet
/// and boxes. The seed changes textures and the posters' and boxes' colours.
std::vector<Solid> furnished_room(std::uint32_t seed);

}  // namespace mms
