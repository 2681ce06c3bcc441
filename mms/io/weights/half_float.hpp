#pragma once

#include <cstdint>
#include <optional>

namespace mms {

/// Bits of the IEEE 754 binary16 number nearest to `value`, ties to even, subnormal where it has to
/// be. Nothing for what rounds beyond 65504, the largest one, and for infinity and NaN.
std::optional<std::uint16_t> half_from_float(float value);

/// The number that binary16 bits stand for; every one fits a float exactly.
float float_from_half(std::uint16_t bits);

/// The number that bfloat16 bits stand for: the upper half of a float.
float float_from_bfloat(std::uint16_t bits);

}  // namespace mms
