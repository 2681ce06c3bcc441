#pragma once

#include <string>
#include <vector>

namespace mms {

/// Index of the camera that an address names.
/// @param address  for messages
/// @param which    its last part: an index or URI; empty: the first camera
/// @param uris     of the cameras that were found, at least one
/// @throws DataError if there is no such camera.
std::size_t chosen_camera(const std::string& address, const std::string& which,
                          const std::vector<std::string>& uris);

}  // namespace mms
