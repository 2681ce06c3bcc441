#include "mms/io/weights/half_float.hpp"

#include <bit>

namespace mms {
namespace {

constexpr std::uint32_t kSign = 0x8000;
constexpr std::uint32_t kFraction = 0x03FF;
constexpr std::uint32_t kExponent = 0x7C00;
constexpr std::uint32_t kDropped = 13;               // bits of a float's fraction that are dropped
constexpr std::uint32_t kBias = (127U - 15U) << 23;  // difference of the exponent biases
constexpr float kTooLarge = 65520.0F;  // half way from 65504 to the next value: rounds up
constexpr float kMinNormal = 0x1p-14F;
constexpr float kMinStep = 0x1p-24F;

/// Subnormal numbers are spaced as floats between 0.5 and 1.
std::uint32_t subnormal_bits(float magnitude) {
  return std::bit_cast<std::uint32_t>(magnitude + 0.5F) - std::bit_cast<std::uint32_t>(0.5F);
}

std::uint32_t normal_bits(float magnitude) {
  const auto bits = std::bit_cast<std::uint32_t>(magnitude) - kBias;
  const std::uint32_t odd = bits >> kDropped & 1U;
  return (bits + (1U << (kDropped - 1)) - 1U + odd) >> kDropped;
}

}  // namespace

std::optional<std::uint16_t> half_from_float(float value) {
  const std::uint32_t sign = std::bit_cast<std::uint32_t>(value) >> 16 & kSign;
  const float magnitude = sign == 0 ? value : -value;
  if (!(magnitude < kTooLarge)) return std::nullopt;
  const std::uint32_t bits =
      magnitude < kMinNormal ? subnormal_bits(magnitude) : normal_bits(magnitude);
  return static_cast<std::uint16_t>(sign | bits);
}

float float_from_half(std::uint16_t bits) {
  const std::uint32_t sign = (bits & kSign) << 16;
  const std::uint32_t exponent = bits & kExponent;
  const std::uint32_t fraction = bits & kFraction;
  std::uint32_t magnitude = (exponent | fraction) << kDropped;
  if (exponent == 0) {
    magnitude = std::bit_cast<std::uint32_t>(static_cast<float>(fraction) * kMinStep);
  } else if (exponent == kExponent) {
    magnitude |= 0x7F800000U;
  } else {
    magnitude += kBias;
  }
  return std::bit_cast<float>(sign | magnitude);
}

float float_from_bfloat(std::uint16_t bits) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
}

}  // namespace mms
