#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"

namespace mms {

/// Pairs (index into `first`, index into `second`) of stamps at most `max_difference` apart, one to
/// one, nearest pairs first, as in associate.py of the TUM benchmark. The inputs need no order; the
/// result is in the order of `first`. Of equal differences the earlier stamps win, of equal
/// stamps the k-th ones are pairs.
std::vector<std::pair<std::size_t, std::size_t>> associate(std::span<const Timestamp> first,
                                                           std::span<const Timestamp> second,
                                                           Duration max_difference);

}  // namespace mms
