#pragma once

#include <cstdint>
#include <optional>

namespace mms {

/// Bits of the IEEE 754 binary16 number nearest to `value`, ties to even, possibly subnormal.
/// nullopt for values that round beyond 65504, the largest one, and for infinity and NaN.
std::optional<std::uint16_t> half_from_float(float value);

/// The value of binary16 bits, exact.
float float_from_half(std::uint16_t bits);

/// The value of bfloat16 bits, the upper half of a float.
float float_from_bfloat(std::uint16_t bits);

}  // namespace mms
