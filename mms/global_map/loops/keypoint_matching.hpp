#pragma once

#include <cstdint>
#include <vector>

#include "mms/global_map/places/binary_descriptor.hpp"

namespace mms {

/// A pair of similar descriptors.
struct KeypointMatch {
  std::uint32_t a = 0;  ///< index of the first one
  std::uint32_t b = 0;  ///< index of the second one
};

/// Pairs that are each other's most similar descriptors, and clearly more similar than the next.
std::vector<KeypointMatch> match_keypoints(const std::vector<BinaryDescriptor>& a,
                                           const std::vector<BinaryDescriptor>& b);

}  // namespace mms
