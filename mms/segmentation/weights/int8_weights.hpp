#pragma once

#include <set>
#include <string>

#include "mms/core/weights.hpp"

namespace mms {

/// Quantizes the named tensors to integers from -127 to 127, with one tensor NAME_scale per tensor
/// NAME for the step of each output channel: its largest magnitude / 127. int8 convolutions use
/// these weights without further loss.
Weights to_bytes(Weights weights, const std::set<std::string>& names);

/// Inverse of `to_bytes`: multiplies by the steps and removes them.
/// @throws DataError at `where` for steps without a tensor, a wrong number of steps, and products
/// beyond the range of float.
Weights from_bytes(Weights weights, const std::string& where);

}  // namespace mms
