#pragma once

#include <cstdint>

namespace mms {

/// What views observed at the position of a point.
enum class SpaceState : std::uint8_t {
  kNone,      ///< not observed: the point is not to be compared
  kSurface,   ///< a surface
  kUnknown,   ///< occluded or out of view
  kNoReturn,  ///< in view, but without a return at or behind it
  kFree,      ///< free space
};

}  // namespace mms
