#pragma once

#include <set>
#include <string>

#include "mms/core/weights.hpp"

namespace mms {

/// Rounds the tensors of some names to what a byte holds: whole numbers of -127 to 127, and beside
/// each tensor NAME one NAME_scale with the step of each output channel, its largest magnitude
/// through 127. These are the weights that an int8 convolution takes, which so loses nothing more.
Weights to_bytes(Weights weights, const std::set<std::string>& names);

/// Multiplies what `to_bytes` made and drops the steps.
/// @throws DataError at `where` for steps without a tensor, or of another number than it has
///         output channels, and for products too large for a float.
Weights from_bytes(Weights weights, const std::string& where);

}  // namespace mms
