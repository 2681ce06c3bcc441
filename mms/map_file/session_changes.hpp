#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "mms/geometry/depth_noise.hpp"
#include "mms/map_file/map_file.hpp"

namespace mms {

/// What the other sessions of a map say about a point of one session.
enum class Change : std::uint8_t {
  kUnchanged,  ///< another session measured a surface there
  kNew,        ///< an earlier session saw through it
  kGone,       ///< the last later session that looked there saw through it
  kUnknown,    ///< no other session looked there
};

constexpr std::string_view to_string(Change change) {
  constexpr std::array<std::string_view, 4> kNames = {"unchanged", "new", "gone", "unknown"};
  return kNames[static_cast<std::size_t>(change)];
}

/// Points of all joined sessions in the frame of the map, each with its change. The vectors are
/// parallel.
struct MapChangeCloud {
  MapCloud map;
  std::vector<Change> changes;
  double voxel_size = 0.0;  ///< the largest of the sessions [m]
};

/// The points with some of the changes, one a voxel.
MapCloud points_of(const MapChangeCloud& cloud, std::initializer_list<Change> changes);

/// Compares the joined sessions of a map, by their order. A point is seen through by a session if
/// two of its keyframes measured a surface behind it, and none one there.
/// @param noise  of the depth images
/// @param warn   called for each damaged part that is left out
MapChangeCloud find_changes(const MapFile& file, const GlobalMapContent& content,
                            const DepthNoise& noise, const MapFile::WarningHandler& warn);

}  // namespace mms
