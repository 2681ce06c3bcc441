#pragma once

#include <string>

#include "mms/mapping/dynamic_map.hpp"

namespace mms {

/// The tracks as JSON: {"tracks": [{"id", "class", "state", "velocity" [m/s], "history": [{"stamp",
/// "centroid", "box_min", "box_max", "velocity"}]}]}, in the world frame [m]; tentative ones left
/// out.
std::string objects_json(const DynamicMap& map);

}  // namespace mms
